# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names of the law of sand whose strength follows from density and stress, as scenes
and run.json have them; nothing else in Python spells them."""

LAW = "Mohr-Coulomb by density and stress"
CRITICAL_ANGLE = "Critical friction angle"  # degrees; the angle in run.json
DENSITY = "Relative density"
MODULUS = "Youngs modulus"  # at REFERENCE_STRESS
REFERENCE_STRESS = "Reference stress"
EXPONENT = "Stiffness exponent"
REFERENCE_VOID_RATIO = "Reference void ratio"  # to which MODULUS belongs
POISSON = "Poisson ratio"
# void ratios of the relative densities 1 and 0; every layer of a scene has them
VOID_RATIOS = ("Minimum void ratio", "Maximum void ratio")
