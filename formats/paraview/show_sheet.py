# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows a run that sheet-export has written: thickness, and beside it what touches solids, with one camera and one
clock.

In ParaView: Macros > Import new macro, choose this file; then it works on the file that is open and chosen. Or at once:

    paraview out/frame.pvd --script=formats/paraview/show_sheet.py
    pvpython show_sheet.py out/frame.pvd --state run.pvsm --picture run.png --time 0.3 --up y
"""
import argparse
import os
import sys

from paraview import simple as pv

LOOK_FROM = {"x": (0.55, 0.5, 0.8), "y": (0.5, 0.55, 0.8), "z": (0.5, -0.8, 0.55)}


def has_array(reader, name):
    return reader.GetPointDataInformation().GetArray(name) is not None


def show_thickness(reader, view):
    """Thickness of each triangle; one scale for all times."""
    display = pv.Show(reader, view)
    pv.ColorBy(display, ("CELLS", "thickness"))
    display.RescaleTransferFunctionToDataRangeOverTime()
    colours = pv.GetColorTransferFunction("thickness")
    colours.ApplyPreset("Viridis (matplotlib)", True)
    bar = pv.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle, bar.Visibility = "thickness [m]", "", 1


def show_touch(reader, view):
    """Where the sheet touches a solid: the array touch has a bit for each, so all from 1 on has one colour."""
    display = pv.Show(reader, view)
    display.InterpolateScalarsBeforeMapping = 0
    pv.ColorBy(display, ("POINTS", "touch"))
    colours = pv.GetColorTransferFunction("touch")
    colours.RGBPoints = [0.0, 0.85, 0.85, 0.85, 1.0, 0.75, 0.2, 0.1]
    bar = pv.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle, bar.Visibility = "touches a solid (1: yes)", "", 1


def prepare(view, up):
    view.CameraViewUp = [float(letter == up) for letter in "xyz"]
    view.CameraFocalPoint, view.CameraPosition = (0, 0, 0), LOOK_FROM[up]
    view.UseColorPaletteForBackground, view.BackgroundColorMode = 0, "Single Color"
    view.Background = (0.97, 0.97, 0.97)
    view.OrientationAxesLabelColor = (0.1, 0.1, 0.1)


def show_run(reader, up="y", time=None):
    """Lays out one view, or two where the sheet can touch something; returns the layout."""
    scene = pv.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    times = list(scene.TimeKeeper.TimestepValues) or [0.0]
    scene.AnimationTime = times[-1]
    reader.UpdatePipeline(times[-1])  # the first frame has no array touch
    if reader.GetCellDataInformation().GetArray("thickness") is None:
        raise ValueError("no array thickness at cells: open what sheet-export has written, without --solidify")
    pv._DisableFirstRenderCameraReset()
    view = pv.GetActiveViewOrCreate("RenderView")
    layout = pv.GetLayout(view)
    views = [view]
    show_thickness(reader, view)
    if has_array(reader, "touch"):
        layout.SplitHorizontal(layout.GetViewLocation(view), 0.5)
        views.append(pv.CreateView("RenderView"))
        pv.AssignViewToLayout(view=views[1], layout=layout, hint=2)
        show_touch(reader, views[1])
    clock = pv.AnnotateTimeFilter(registrationName="Time", Input=reader)
    clock.Format = "{time:.4f} s"
    label = pv.Show(clock, view)
    label.Color, label.FontSize = (0.1, 0.1, 0.1), 14
    scene.AnimationTime = max((t for t in times if time is None or t <= time + 1e-9), default=times[0])
    for each in views:
        prepare(each, up)
        for bar in (r for r in each.Representations if r.GetXMLName() == "ScalarBarWidgetRepresentation"):
            bar.TitleColor = bar.LabelColor = (0.1, 0.1, 0.1)
        pv.ResetCamera(each)
    if len(views) == 2:
        pv.AddCameraLink(view, views[1], "Sheet")
    pv.SetActiveView(view)
    pv.RenderAllViews()
    return layout


def main(arguments):
    parser = argparse.ArgumentParser(prog="show_sheet.py", description="shows a run that sheet-export has written")
    parser.add_argument("collection", help=".pvd or .vtu file of sheet-export")
    parser.add_argument("--up", choices=LOOK_FROM, default="y", help="the axis that points upwards (default: y)")
    parser.add_argument("--time", type=float,
                        help="moment to show [s]: the last frame that is not later (default: the end)")
    parser.add_argument("--state", help="write a state file (.pvsm) for ParaView's File > Load State")
    parser.add_argument("--picture", help="write a picture (.png)")
    options = parser.parse_args(arguments)
    if not os.path.isfile(options.collection):
        parser.error(f"{options.collection}: no such file; sheet-export run.sheet -o out/frame_%04d.vtu writes"
                     f" out/frame.pvd")
    try:
        layout = show_run(pv.OpenDataFile(os.path.abspath(options.collection)), options.up, options.time)
    except ValueError as error:
        parser.error(f"{options.collection}: {error}")
    if options.state:
        pv.SaveState(os.path.abspath(options.state))
    if options.picture:
        layout.SetSize(1200, 500)
        pv.SaveScreenshot(options.picture, layout, ImageResolution=(1200, 500))


if len(sys.argv) > 1 and not sys.argv[0].endswith("paraview"):
    main(sys.argv[1:])
elif pv.GetActiveSource() is not None:
    show_run(pv.GetActiveSource())
else:
    raise SystemExit("open a .pvd file of sheet-export first, then run this macro")
