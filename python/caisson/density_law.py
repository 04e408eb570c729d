# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names of the laws of sand whose strength follows from density and stress, and of
their entries, as scenes and run.json have them; nothing else in Python spells them."""

LAW = "Mohr-Coulomb by density and stress"
HYPOPLASTIC = "hypoplastic sand with intergranular strain"
# in run.json the friction angle of these laws is the critical one
BY_DENSITY = (HYPOPLASTIC, LAW)

# entries of LAW alone
CRITICAL_ANGLE = "Critical friction angle"  # degrees
MODULUS = "Youngs modulus"  # at REFERENCE_STRESS and REFERENCE_VOID_RATIO
REFERENCE_STRESS = "Reference stress"
REFERENCE_VOID_RATIO = "Reference void ratio"
EXPONENT = "Stiffness exponent"
POISSON = "Poisson ratio"

# of every layer; the void ratios are those of the relative densities 1 and 0
DENSITY = "Relative density"
DENSEST, LOOSEST = "Minimum void ratio", "Maximum void ratio"
