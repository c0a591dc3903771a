# SPDX-License-Identifier: GPL-3.0-or-later
"""What a hand does in Blender's window, without a terminal: model, choose in the panel, simulate, cancel by Escape,
resume, look, render.

    blender --factory-startup --enable-event-simulate --python test_window.py -- sheet-blender.zip [PICTURES]

PICTURES: a folder for panel.png (the window) and result.png (the picture).
"""
import os
import pathlib
import sys
import tempfile
import time
import traceback

import bpy
import numpy as np

archive = sys.argv[sys.argv.index("--") + 1]
rest = sys.argv[sys.argv.index("--") + 2:]
work = pathlib.Path(tempfile.mkdtemp())
pictures = pathlib.Path(rest[0]).resolve() if rest else work
LONG, SHORT = 2000, 30  # frames: to be cancelled, to be gone on with


def look_at(thing, target):
    thing.rotation_euler = (target - thing.location).to_track_quat("-Z", "Y").to_euler()


def material(name, colour, texture=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.diffuse_color = (*colour, 1)
    surface = made.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value, surface.inputs["Roughness"].default_value = (*colour, 1), 0.3
    if texture is not None:
        node = made.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = texture
        made.node_tree.links.new(node.outputs["Color"], surface.inputs["Base Color"])
    return made


def model():
    """A cloth of liquid with a texture on its left half and a plain colour on its right one, above a ball."""
    for old in list(bpy.data.objects):
        if old.type == "MESH":
            bpy.data.objects.remove(old)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.08, location=(0, 0, 0.02), segments=48, ring_count=24)
    bpy.ops.object.shade_smooth()
    ball = bpy.context.object
    ball.name = "Ball"
    ball.data.materials.append(material("Porcelain", (0.8, 0.8, 0.75)))
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=20, y_subdivisions=20, size=0.3, location=(0, 0, 0.11))
    cloth = bpy.context.object
    cloth.name = "Cloth"
    grid = bpy.data.images.new("Grid", 512, 512)
    grid.generated_type = "COLOR_GRID"
    cloth.data.materials.append(material("Printed", (0.2, 0.4, 0.8), grid))
    cloth.data.materials.append(material("Plain", (0.7, 0.15, 0.05)))
    for face in cloth.data.polygons:
        face.material_index = int(face.center.x > 0.03)
    return cloth, ball


def show_physics(window):
    area = next(area for area in window.screen.areas if area.type == "PROPERTIES")
    area.spaces.active.context = "PHYSICS"
    view = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    view.spaces.active.shading.type = "MATERIAL"
    region = view.spaces.active.region_3d
    region.view_location, region.view_distance = (0, 0, 0.03), 0.75


def newest_is_shown(scene, cloth):
    shown = cloth.sheet_part.result
    return shown is not None and len(shown.data.vertices) > 0 and scene.frame_current > scene.frame_start


def steps():
    """Yields what to wait for: a function, at most 60 s each."""
    bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module="sheet_blender")
    import sheet_blender
    cache = sheet_blender.cache
    bpy.ops.wm.save_as_mainfile(filepath=str(work / "tea.blend"))
    window, scene = bpy.context.window_manager.windows[0], bpy.context.scene
    scene.render.fps, scene.frame_start, scene.frame_end = 50, 1, LONG
    with bpy.context.temp_override(window=window):
        cloth, ball = model()
        show_physics(window)
    # the panel
    cloth.sheet_part.role, ball.sheet_part.role = "SHEET", "SOLID"
    cloth.sheet_part.thickness, cloth.sheet_part.edges = 0.006, 0.008
    scene.sheet_run.liquid = "honey"
    scene.sheet_run.viscosity, scene.sheet_run.liquid = 600, "own"
    with bpy.context.temp_override(window=window):
        assert bpy.ops.sheet.check("EXEC_DEFAULT") == {"FINISHED"}
        assert bpy.ops.sheet.simulate("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    folder = cache.folder_of(scene, cloth)
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
    assert scene.frame_end == last and cloth.hide_get()
    with bpy.context.temp_override(window=window):
        bpy.context.view_layer.objects.active = cloth
        show_physics(window)
    for _ in range(10):
        yield lambda: True
    bpy.ops.screen.screenshot(filepath=str(pictures / "panel.png"))
    render(scene)
    picture = bpy.data.images.load(str(pictures / "result.png"))
    pixels = np.array(picture.pixels[:]).reshape(-1, 4)[:, :3]
    red = (pixels[:, 0] > 1.8 * pixels[:, 1]) & (pixels[:, 0] > 0.15)
    gaudy = pixels.max(axis=1) > 1.5 * pixels.min(axis=1)
    assert red.mean() > 0.03 and (gaudy & ~red).mean() > 0.02, (red.mean(), gaudy.mean())


def render(scene):
    from mathutils import Vector
    camera = scene.camera
    camera.data.lens = 60
    camera.location = (0.3, -0.5, 0.4)
    look_at(camera, Vector((0, 0, -0.01)))
    lamp = next(thing for thing in scene.objects if thing.type == "LIGHT")
    lamp.data.type, lamp.data.energy, lamp.location = "SUN", 3, (1, -1, 2)
    look_at(lamp, Vector((0, 0, 0)))
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.5, 0.55, 0.6, 1)
    scene.render.engine, scene.cycles.samples = "CYCLES", 32
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 480, 360, 100
    scene.view_settings.view_transform = "Standard"
    scene.render.filepath = str(pictures / "result.png")
    bpy.ops.render.render(write_still=True)


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
        elif time.monotonic() - state["since"] > 60:
            raise TimeoutError(f"waited in vain in line {state['steps'].gi_frame.f_lineno}")
    except StopIteration:
        print("window: ok", flush=True)
        os._exit(0)  # Blender's own end needs a hand that says what to do with the file
    except BaseException:
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)
    return 0.1


bpy.app.timers.register(advance, first_interval=1.0, persistent=True)
