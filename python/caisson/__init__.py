# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs, results, studies, pictures and checks of caisson_mpm.

Everything around the program that is not the program itself. The modules, each
above those that it uses:

    paths, table, machine   where things are, how tables look, what a number
                            was measured on
    scenes                  the scenes that come with the program
    runner                  Run: one call of the program with entries set
    results                 Results: what a run has left in its directory
    curves                  means over windows and other numbers of a curve
    design                  solutions to compare with (no program needed)
    plot                    pictures of a run
    study                   the format of all studies, and how they are run
    verification, accuracy, error_bar, stability, forces, parameters, drainage,
    speed                   what a study is for: each evaluates one kind
    cpt, suggest            layers from a cone test, and scenes for one's own caisson
    developer               checks of the sources

scripts/caisson is the command line. Needed besides Python 3.11: numpy,
SciPy, matplotlib, VTK and Jinja2, as Debian packages them.

Units are SI, angles in degrees, unless a name says otherwise (wall_kN). Arrays
are given with their shapes, as in [n_rows].
"""
