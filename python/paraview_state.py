# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens the run in CAISSON_MPM_RESULTS in ParaView: the section of soil and body at
+-1.5 diameters, on the left the vertical effective stress, on the right its ratio to
that at rest. `pvpython FILE DIR` writes DIR/paraview.png instead.

With a body, the time of ParaView is the penetration.
"""
import json
import os
import sys

from paraview import simple

STRESS = "vertical_effective_stress_kPa"
RATIO = "vertical_stress_over_stress_at_rest"
GRAY, BLACK = [0.45] * 3, [0.0] * 3
SIZE = [1600, 1000]  # pixels


def scene_of(directory):
    """Return the body and the layers of run.json, nothing before the run's end."""
    path = os.path.join(directory, "run.json")
    if not os.path.isfile(path):
        return {}
    with open(path, encoding="utf-8") as file:
        return json.load(file).get("scene") or {}


def series_of(directory, name):
    """Return a series of frames, by penetration where there is a body, or None."""
    for ending in ("_by_penetration.pvd", ".pvd"):
        path = os.path.join(directory, name + ending)
        if os.path.isfile(path):
            return simple.PVDReader(FileName=path)
    return None


def show_flat(source, view, color):
    """Show a source in one color, without light."""
    shown = simple.Show(source, view)
    shown.ColorArrayName = [None, ""]
    shown.Ambient, shown.Diffuse = 1, 0
    shown.AmbientColor = shown.DiffuseColor = color
    return shown


def show_field(source, view, field, title, place):
    """Show a field of the cells with its color bar; return its colors."""
    shown = simple.Show(source, view)
    shown.Ambient, shown.Diffuse = 1, 0
    simple.ColorBy(shown, ("CELLS", field))
    colors = simple.GetColorTransferFunction(field)
    bar = simple.GetScalarBar(colors, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.Orientation, bar.WindowLocation = "Horizontal", "Any Location"
    bar.Position, bar.ScalarBarLength = place, 0.33
    bar.TitleFontSize = bar.LabelFontSize = 14
    bar.RangeLabelFormat = "%.3g"
    shown.SetScalarBarVisibility(view, True)
    return colors


def show_soil(grid, view):
    """Show both halves of the soil."""
    soil = simple.Threshold(Input=grid, Scalars=["CELLS", "material_points"])
    soil.ThresholdMethod, soil.UpperThreshold = "Above Upper Threshold", 1
    left = simple.Reflect(Input=soil, Plane="X", CopyInput=0)
    title = "left: vertical effective stress (kPa)"
    stress = show_field(left, view, STRESS, title, [0.08, 0.03])
    highest = grid.CellData.GetArray(STRESS).GetRange()[1]
    stress.ApplyPreset("Turbo", True)
    stress.RescaleTransferFunction(0, max(highest / 4, 1))  # the tip would take all
    title = "right: vertical effective stress over that at rest (-)"
    ratio = show_field(soil, view, RATIO, title, [0.58, 0.03])
    ratio.ApplyPreset("Cool to Warm", True)  # white where it is as before
    ratio.RescaleTransferFunction(0.1, 10)
    ratio.MapControlPointsToLogSpace()
    ratio.UseLogScale = 1


def show_layers(layers, view, width):
    """Draw the boundaries between layers where they were at the start."""
    tops = {layer["layer"]: layer["top_depth_m"] for layer in reversed(layers)}
    for depth in tops.values():
        ends = [[side * width, -depth, 0.01] for side in (-1, 1)]
        line = simple.Line(Point1=ends[0], Point2=ends[1])
        show_flat(line, view, BLACK).LineWidth = 1.5


def place_camera(view, width, depth):
    """Look at +-width (m), and at least as deep as the body needs."""
    height = max(2 * width * SIZE[1] / SIZE[0], 1.5 * depth)
    middle = 0.12 * height - height / 2  # room for the part above the ground
    view.InteractionMode, view.ViewSize = "2D", SIZE
    view.CameraPosition, view.CameraFocalPoint = [0, middle, 100], [0, middle, 0]
    view.CameraViewUp, view.CameraParallelScale = [0, 1, 0], height / 2


arguments = [argument for argument in sys.argv[1:] if os.path.isdir(argument)]
directory = (arguments or [os.environ.get("CAISSON_MPM_RESULTS", "results/jack")])[0]
grid, body = [series_of(directory, name) for name in ("grid", "body")]
if grid is None:
    sys.exit(f"no grid.pvd in {directory}: give the output directory of a run")
simple.LoadPalette("WhiteBackground")
view = simple.GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 0
grid.UpdatePipeline(list(grid.TimestepValues)[-1])
if grid.CellData.GetArray(RATIO) is None:
    sys.exit(f"the frames in {directory} are of an earlier version: no {RATIO}")
simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
simple.GetAnimationScene().GoToLast()
scene, bounds = scene_of(directory), grid.GetDataInformation().GetBounds()
width, depth = bounds[1], -bounds[2]
if body is not None:
    body.UpdatePipeline(list(body.TimestepValues)[-1])
    box = body.GetDataInformation().GetBounds()
    width, depth = min(3 * box[1], width), max(-box[2], 0)  # 1.5 diameters
show_soil(grid, view)
show_layers(scene.get("layers", []), view, width)
if body is not None:
    show_flat(simple.Reflect(Input=body, Plane="X"), view, GRAY)
label = "penetration {time:.2f} m" if body is not None else "time {time:.4g} s"
text = simple.AnnotateTimeFilter(Input=grid, Format=label)
shown_text = simple.Show(text, view)
shown_text.FontSize, shown_text.Color = 20, BLACK
simple.Render(view)  # the first time, this moves the camera
place_camera(view, width, depth)
if arguments:
    simple.SaveScreenshot(
        os.path.join(directory, "paraview.png"), view, ImageResolution=SIZE
    )
