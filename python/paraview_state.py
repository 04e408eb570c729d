# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens the run in CAISSON_MPM_RESULTS in ParaView: the stress of the soil and the body
as a solid, mirrored on the axis. `pvpython FILE DIR` writes DIR/paraview.png instead.
"""
import os
import sys

from paraview import simple

FIELD = "stress_zz_Pa"
arguments = [argument for argument in sys.argv[1:] if os.path.isdir(argument)]
directory = (arguments or [os.environ.get("CAISSON_MPM_RESULTS", "results/jack")])[0]
series = [os.path.join(directory, name) for name in ("grid.pvd", "body.pvd")]
if not os.path.isfile(series[0]):
    sys.exit(f"no {series[0]}: give the output directory of a run")
view = simple.GetActiveViewOrCreate("RenderView")
grid, *body = [simple.PVDReader(FileName=s) for s in series if os.path.isfile(s)]
grid.UpdatePipeline(list(grid.TimestepValues)[-1])
if grid.PointData.GetArray(FIELD) is None:
    sys.exit(f"{series[0]} is of an earlier version: it has no {FIELD}")
soil = simple.Threshold(Input=grid, Scalars=["POINTS", "material_points"])
soil.ThresholdMethod, soil.UpperThreshold = "Above Upper Threshold", 1
parts = [simple.Reflect(Input=part, Plane="X") for part in (soil, *body)]
shown, *solid = [simple.Show(part, view) for part in parts]
for part in (shown, *solid):
    part.Ambient, part.Diffuse, part.DiffuseColor = 1, 0, [0.45, 0.45, 0.45]
    part.AmbientColor, part.ColorArrayName = part.DiffuseColor, [None, ""]
simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
simple.GetAnimationScene().GoToLast()
simple.ColorBy(shown, ("POINTS", FIELD))
shown.SetScalarBarVisibility(view, True)
lowest = grid.PointData.GetArray(FIELD).GetRange()[0]
colors = simple.GetColorTransferFunction(FIELD)
colors.ApplyPreset("Warm to Cool", True)  # warm where the compression is high
colors.RescaleTransferFunction(lowest / 4, 0)  # the tip would take all colors
view.InteractionMode, view.ViewSize = "2D", [1600, 1000]
simple.ResetCamera(view)
simple.Render(view)
if arguments:
    simple.SaveScreenshot(os.path.join(directory, "paraview.png"), view)
