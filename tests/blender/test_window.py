# SPDX-License-Identifier: GPL-3.0-or-later
"""What a hand does in Blender's window, without a terminal: model two sheets, choose in the panel, simulate, cancel by
Escape, resume, look, render.

    blender --factory-startup --enable-event-simulate --python test_window.py -- sheet-blender.zip [PICTURES]

PICTURES: a folder for panel.png (the window) and result.png (the picture).
"""
import importlib.util
import os
import pathlib
import shutil
import sys
import tempfile
import time
import traceback

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from simulating import add_on

rest = sys.argv[sys.argv.index("--") + 2:]
work = pathlib.Path(tempfile.mkdtemp())
pictures = pathlib.Path(rest[0]).resolve() if rest else work
example = pathlib.Path(__file__).resolve().parents[2] / "formats/blender/example_simulate.py"
specification = importlib.util.spec_from_file_location("example_simulate", example)  # not the add-on beside it
example_simulate = importlib.util.module_from_spec(specification)
specification.loader.exec_module(example_simulate)
LONG, SHORT = 2000, 30  # frames: to be cancelled, to be gone on with


def show_physics(window):
    area = next(area for area in window.screen.areas if area.type == "PROPERTIES")
    area.spaces.active.context = "PHYSICS"
    if area.width < 400:
        bpy.ops.screen.area_move(x=area.x - 1, y=area.y + area.height // 2, delta=-150)
    view = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    view.spaces.active.shading.type = "MATERIAL"
    region = view.spaces.active.region_3d
    region.view_location, region.view_distance = (0, 0, 0.03), 0.5


def add_icing():
    """A second sheet above the first, of another liquid."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=16, y_subdivisions=16, size=0.14, location=(0, 0, 0.125))
    icing = bpy.context.object
    icing.name = "Icing"
    part = icing.sheet_part
    part.role, part.thickness, part.edges, part.liquid.own = "SHEET", 0.005, 0.008, True
    part.liquid.liquid = "caramel"
    part.liquid.look = "chocolate"


def newest_is_shown(scene, cloth):
    shown = cloth.sheet_part.result
    return shown is not None and len(shown.data.vertices) > 0 and scene.frame_current > scene.frame_start


def steps():
    """Yields what to wait for: a function, at most 120 s each."""
    sheet_blender = add_on()
    cache = sheet_blender.cache
    bpy.ops.wm.save_as_mainfile(filepath=str(work / "tea.blend"))
    window, scene = bpy.context.window_manager.windows[0], bpy.context.scene
    with bpy.context.temp_override(window=window):
        cloth, ball = example_simulate.model()
        example_simulate.choose(scene, cloth, ball, LONG)
        add_icing()
        show_physics(window)
        assert bpy.ops.sheet.check("EXEC_DEFAULT") == {"FINISHED"}
        assert bpy.ops.sheet.simulate("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    folder = cache.folder_of(scene)
    yield lambda: newest_is_shown(scene, cloth) and cache.progress_of(folder).frames >= 3
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=str(work / "tea.blend"))  # while it goes on
    window, scene = bpy.context.window_manager.windows[0], bpy.context.scene
    cloth, seen = scene.objects["Cloth"], scene.frame_current
    yield lambda: sheet_blender.simulate._watched and scene.frame_current > seen  # it is found again
    bpy.ops.screen.screenshot(filepath=str(pictures / "running.png"))
    window.event_simulate(type="ESC", value="PRESS")
    window.event_simulate(type="ESC", value="RELEASE")
    yield lambda: not sheet_blender.simulate._watched
    stopped = cache.progress_of(folder)
    assert stopped.state == "stopped" and 3 <= stopped.frames < LONG, stopped
    last = scene.frame_end = max(SHORT, stopped.frames + 10)
    with bpy.context.temp_override(window=window):
        assert bpy.ops.sheet.resume("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield lambda: not sheet_blender.simulate._watched
    assert cache.progress_of(folder).state == "done" and scene.frame_current == last, scene.frame_current
    shown = cloth.sheet_part.result
    assert shown.name == "Cloth sheet" and [m.name for m in shown.data.materials] == ["Printed", "Plain"]
    kinds = np.empty(len(shown.data.polygons), np.int32)
    shown.data.polygons.foreach_get("material_index", kinds)
    assert 0 < kinds.mean() < 1
    icing = scene.objects["Icing"]
    second = icing.sheet_part.result
    assert second.name == "Icing sheet" and [m.name for m in second.data.materials] == ["Sheet chocolate"]
    assert shown.sheet.number == 0 and second.sheet.number == 1 and icing.hide_get()
    places = np.array([second.matrix_world @ v.co for v in second.data.vertices])
    assert len(places) > 200 and np.abs(places[:, 0]).max() < 0.12, len(places)
    assert scene.frame_end == last and cloth.hide_get()
    with bpy.context.temp_override(window=window):
        bpy.context.view_layer.objects.active = icing
        show_physics(window)
    for _ in range(10):
        yield lambda: True
    bpy.ops.screen.screenshot(filepath=str(pictures / "panel.png"))
    example_simulate.render(scene, pictures / "result.png")
    picture = bpy.data.images.load(str(pictures / "result.png"))
    pixels = np.array(picture.pixels[:]).reshape(-1, 4)[:, :3]
    red = (pixels[:, 0] > 1.8 * pixels[:, 1]) & (pixels[:, 0] > 0.15)
    gaudy = pixels.max(axis=1) > 1.5 * pixels.min(axis=1)
    assert red.mean() > 0.03 and (gaudy & ~red).mean() > 0.02, (red.mean(), gaudy.mean())
    with bpy.context.temp_override(window=window):
        bpy.ops.sheet.free("INVOKE_DEFAULT")
    for _ in range(5):
        yield lambda: True
    assert (folder / "run/run.sheet").exists() and cloth.hide_get()  # it asks, and nobody has said yes
    window.event_simulate(type="ESC", value="PRESS")
    window.event_simulate(type="ESC", value="RELEASE")
    yield lambda: True
    assert (folder / "run/run.sheet").exists()
    assert bpy.ops.sheet.free("EXEC_DEFAULT") == {"FINISHED"}
    assert not folder.exists() and not cloth.hide_get() and "Cloth sheet" not in bpy.data.objects
    assert "Icing sheet" not in bpy.data.objects and not icing.hide_get()


state = {"steps": None, "until": None, "since": 0.0}


def advance():
    try:
        if state["steps"] is None:
            state["steps"] = steps()
            state["until"] = next(state["steps"])
            state["since"] = time.monotonic()
        elif state["until"]():
            state["until"] = next(state["steps"])
            state["since"] = time.monotonic()
        elif time.monotonic() - state["since"] > 120:
            raise TimeoutError(f"waited in vain in line {state['steps'].gi_frame.f_lineno}")
    except StopIteration:
        print("window: ok", flush=True)
        end(0)
    except BaseException:
        traceback.print_exc()
        end(1)
    return 0.1


def end(code):
    """Blender's own end needs a hand that says what to do with the file."""
    if "sheet_blender" in sys.modules:
        sys.modules["sheet_blender"].cache.stop(work / "tea_sheet/Cloth")
    shutil.rmtree(work, ignore_errors=True)
    sys.stdout.flush()
    os._exit(code)


bpy.app.timers.register(advance, first_interval=1.0, persistent=True)
