# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens a run in ParaView: material points coloured by vertical effective
stress, mirrored on the axis.

Usage: paraview --script=scripts/paraview_state.py   with CAISSON_MPM_RESULTS
set to the output directory (default: results/jack). With pvpython DIR as an
argument it writes DIR/paraview.png instead of opening a window.
"""
import os
import sys

from paraview import simple

arguments = [argument for argument in sys.argv[1:] if os.path.isdir(argument)]
directory = (arguments or [os.environ.get("CAISSON_MPM_RESULTS", "results/jack")])[0]
series = os.path.join(directory, "points.pvd")
if not os.path.isfile(series):
    sys.exit(f"no {series}: give the output directory of a run")

points = simple.PVDReader(FileName=series)
mirrored = simple.Reflect(Input=points, Plane="X")
view = simple.GetActiveViewOrCreate("RenderView")
shown = simple.Show(mirrored, view)
shown.SetRepresentationType("Points")
shown.PointSize = 3
simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
simple.GetAnimationScene().GoToLast()
simple.ColorBy(shown, ("POINTS", "stress_zz"))
shown.RescaleTransferFunctionToDataRange()
shown.SetScalarBarVisibility(view, True)
view.InteractionMode = "2D"
simple.ResetCamera(view)
simple.Render(view)
if arguments:
    simple.SaveScreenshot(os.path.join(directory, "paraview.png"), view)
