# SPDX-License-Identifier: GPL-3.0-or-later
"""Imported runs and bodies: objects whose meshes follow the scene's time."""
from __future__ import annotations

import math
import os
import pathlib
from typing import Any

import bpy
import numpy as np
from bpy.app.handlers import persistent
from mathutils import Matrix, Vector

from . import body_files, carried, compat
from .compat import sheetstream
from .drops import add_drops, follow_drops, has_drops
from .errors import SheetError
from .looks import set_materials
from .meshes import fill_body, fill_mesh, set_slots
from .selection import sheet_of
from .slab import add_slab
from .solids import add_solids


_runs: dict[str, tuple[tuple[int, float], sheetstream.Run]] = {}


def open_run(path: str) -> sheetstream.Run:
    """The run of a file, indexed once as long as the file stays the same; a run that goes on is taken as far as it
    is."""
    full = bpy.path.abspath(path)
    try:
        state = os.stat(full)
        key = (state.st_size, state.st_mtime)
        if full not in _runs or _runs[full][0] != key:
            _runs[full] = (key, sheetstream.Run(full, partial=True))
    except OSError as error:
        raise SheetError(f"{full}: {error.strerror}") from error
    except sheetstream.StreamError as error:
        raise SheetError(str(error) if full in str(error) else f"{full}: {error}") from error
    run = _runs[full][1]
    if not len(run):
        raise SheetError(f"{full}: the stream has no frames")
    return run


def forget(path: str) -> None:
    """The file has been replaced, perhaps by one of the same size within a second."""
    _runs.pop(bpy.path.abspath(path), None)


def frame_at(run: sheetstream.Run, time: float, between: bool) -> tuple[sheetstream.Frame, Any]:
    """The run's last frame that is not later, and where its vertices are at that time [m]: where they were in the
    frame, or (between frames) on a straight line to the next frame, with their velocity where the mesh changes."""
    i = max(0, int(np.searchsorted(run.times, time + 1e-9, "right")) - 1)
    try:
        frame = run[i]
        position = frame["position"]
        ahead = min(time, run.times[-1]) - frame.time
        if not between or ahead <= 1e-9 or i + 1 == len(run):
            return frame, position
        after = run[i + 1]
    except (OSError, sheetstream.StreamError) as error:
        raise SheetError(str(error)) from error
    if np.array_equal(after["triangle"], frame["triangle"]) and after.vertices == frame.vertices:
        return frame, position + (after["position"] - position) * (ahead / (after.time - frame.time))
    return frame, position + ahead * frame.velocity()


_bodies: dict[str, tuple[tuple[int, float], body_files.BodySequence]] = {}


def open_bodies(path: str, rate: float) -> body_files.BodySequence:
    """The files of `sheet-export --union` that one of them belongs to, listed once as long as their folder stays the
    same. Those that do not say their time follow each other `rate` times a second."""
    full = pathlib.Path(bpy.path.abspath(path))
    try:
        key = (os.stat(full.parent).st_mtime_ns, rate)
        if str(full) not in _bodies or _bodies[str(full)][0] != key:
            _bodies[str(full)] = (key, body_files.BodySequence(full, rate))
    except OSError as error:
        raise SheetError(f"{full}: {error.strerror}") from error
    except body_files.BodyError as error:
        raise SheetError(str(error)) from error
    return _bodies[str(full)][1]


def time_of(scene: bpy.types.Scene, settings: Any) -> float:
    """Time in the run [s] at the scene's frame (and subframe)."""
    rate = scene.render.fps / scene.render.fps_base
    return max(0.0, (scene.frame_current_final - settings.start) / rate * settings.speed) + settings.first_time


def update_object(thing: bpy.types.Object, scene: bpy.types.Scene) -> None:
    """Brings an imported object to the scene's frame. What is wrong is shown in its panel; the mesh stays as it was."""
    settings = thing.sheet
    try:
        settings.message = _follow_bodies(thing, scene) if has_bodies(settings.file) else _follow_run(thing, scene)
    except SheetError as error:
        settings.message = f"Error: {error}"
        print(f"Sheet: {thing.name}: {error}")


def has_bodies(path: str) -> bool:
    """Whether a file is one of `sheet-export --union`, not a run."""
    return path.lower().endswith(".ply")


def _follow_run(thing: bpy.types.Object, scene: bpy.types.Scene) -> str:
    settings = thing.sheet
    run = open_run(settings.file)
    frame, position = frame_at(run, time_of(scene, settings), settings.between)
    if settings.number >= 0:
        frame, position = sheet_of(frame, position, settings.number)
    fill_mesh(thing.data, frame, position, settings.speed)
    if settings.by_liquid:
        set_slots(thing.data, frame["liquid"] if "liquid" in frame else np.zeros(len(thing.data.polygons)))
    ahead = min(time_of(scene, settings), float(run.times[-1])) - frame.time if settings.between else 0.0
    follow_drops(thing, frame, max(0.0, ahead), settings.speed)
    layers = carried.beside(settings.file, settings.mesh_file)
    if layers is not None:
        layers.put(thing.data, frame, materials=not settings.by_liquid)
    return f"frame {int(np.searchsorted(run.times, frame.time))} of {len(run)}, {frame.time:.4g} s"


def _follow_bodies(thing: bpy.types.Object, scene: bpy.types.Scene) -> str:
    settings = thing.sheet
    bodies = open_bodies(settings.file, scene.render.fps / scene.render.fps_base)
    time = min(time_of(scene, settings), bodies.times[-1])
    i = max(0, int(np.searchsorted(bodies.times, time + 1e-9, "right")) - 1)
    try:
        body = bodies[i]
    except OSError as error:
        raise SheetError(f"{bodies.files[i]}: {error.strerror}") from error
    except body_files.BodyError as error:
        raise SheetError(str(error)) from error
    fill_body(thing.data, body, max(0.0, time - bodies.times[i]) if settings.between else 0.0, settings.speed)
    return f"{bodies.files[i].name}, {i} of {len(bodies)}, {bodies.times[i]:.4g} s"


@persistent
def on_frame_change(scene: bpy.types.Scene, _depsgraph: Any = None) -> None:
    """Before anything is evaluated for a new frame, in viewport and rendering."""
    for thing in scene.objects:
        if thing.type == "MESH" and thing.sheet.file:
            update_object(thing, scene)


def import_run(path: str, material: str = "caramel,...", up: str = "AUTO", start: int = 1, speed: float = 1.0,
               between: bool = True, slab: bool = True, solids: bool = True, adapt_scene: bool = True,
               scene: bpy.types.Scene | None = None) -> bpy.types.Object:
    """Adds a run to the scene as an object whose mesh follows the time; returns it. Of a run of several sheets that was
    simulated in Blender each is an object, with the UV maps, colours and materials that it carries; the first one is
    returned. Raises SheetError.

    Blender's frame `start` shows the run's first frame; `speed` seconds of the run pass in a second. up: the run's axis
    that points upwards (X, Y, Z, or AUTO: against the gravity of its scene). material: a preset; of several liquids
    those of the first, the second, ..., with commas, and again from the first, or, where "..." is last, by others that
    tell them apart.
    """
    scene = scene or bpy.context.scene
    run = open_run(path)
    described = scene_of(run)
    liquids = _count_liquids(described)
    things = []
    for number, (name, mesh_file) in _sheets_in(described, run).items():
        thing = _add_object(path, _upright(described, up), run.times, start, speed, between, scene)
        thing.name = f"{thing.name} {name}" if number >= 0 else thing.name
        thing.sheet.mesh_file, thing.sheet.number = mesh_file, number
        if slab:
            add_slab(thing)
        set_materials(thing, material, scene, liquids)
        thing.sheet.by_liquid = len(thing.data.materials) > 1
        things.append(thing)
    if has_drops(described):
        add_drops(things[0])
    if adapt_scene:
        _adapt_scene(things[0], run.times, scene)
    if solids:
        add_solids(described, things[0], scene)
    for thing in things:
        _show_first(thing, scene)
    return things[0]


def import_bodies(path: str, material: str = "caramel", up: str = "Y", start: int = 1, speed: float = 1.0,
                  between: bool = True, adapt_scene: bool = True,
                  scene: bpy.types.Scene | None = None) -> bpy.types.Object:
    """Adds the files that `sheet-export --union` has written of a run, of which `path` names one, to the scene as an
    object whose mesh follows the time; returns it. Raises SheetError.

    up: the axis of the files that points upwards (X, Y, Z); start, speed: as of import_run.
    """
    scene = scene or bpy.context.scene
    bodies = open_bodies(path, scene.render.fps / scene.render.fps_base)
    thing = _add_object(path, _upright({}, up), bodies.times, start, speed, between, scene)
    set_materials(thing, material, scene)
    if adapt_scene:
        _adapt_scene(thing, bodies.times, scene)
    _show_first(thing, scene)
    return thing


def _add_object(path: str, turn: Matrix, times: Any, start: int, speed: float, between: bool,
                scene: bpy.types.Scene) -> bpy.types.Object:
    """An object without a mesh yet that follows a file from the first of these times on."""
    name = pathlib.Path(path).stem
    thing = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    scene.collection.objects.link(thing)
    thing.matrix_world = Matrix.Scale(1 / scene.unit_settings.scale_length, 4) @ turn
    settings = thing.sheet
    settings.start, settings.speed, settings.between = start, speed, between
    settings.first_time = float(times[0])
    settings.file = path
    return thing


def _adapt_scene(thing: bpy.types.Object, times: Any, scene: bpy.types.Scene) -> None:
    scene.unit_settings.system = "METRIC"
    scene.render.use_lock_interface = True  # meshes change while a picture is rendered
    rate = scene.render.fps / scene.render.fps_base
    last = thing.sheet.start + math.ceil(float(times[-1] - times[0]) / thing.sheet.speed * rate - 1e-6)
    another = any(other.sheet.file for other in scene.objects if other is not thing)
    scene.frame_end = max(scene.frame_end, last) if another else last


def _show_first(thing: bpy.types.Object, scene: bpy.types.Scene) -> None:
    update_object(thing, scene)
    if thing.sheet.message.startswith("Error"):
        raise SheetError(thing.sheet.message[7:])


def _sheets_in(described: dict[str, Any], run: sheetstream.Run) -> dict[int, tuple[str, str]]:
    """{number: (name, mesh file)} of the sheets that are shown apart, or of all as one, whose number is -1."""
    sheets = described.get("sheet")
    if isinstance(sheets, list) and carried.SHEET in run[0]:
        return {number: (str(sheet.get("name", number)), _mesh_file_of(sheet)) for number, sheet in enumerate(sheets)}
    return {-1: ("", _mesh_file_of(sheets))}


def _count_liquids(described: dict[str, Any]) -> int:
    """As the array "liquid" counts: that of [material], then those of [sheet.material], each once."""
    sheets = described.get("sheet")
    liquids = [described.get("material")]
    for sheet in sheets if isinstance(sheets, list) else []:
        if "material" in sheet and sheet["material"] not in liquids:
            liquids.append(sheet["material"])
    return len(liquids)


def _mesh_file_of(sheet: Any) -> str:
    file = sheet.get("file", "") if isinstance(sheet, dict) else ""
    return file if isinstance(file, str) else ""


def scene_of(run: sheetstream.Run) -> dict[str, Any]:
    """The scene's tables; empty if it has none that can be read. Raises SheetError."""
    try:
        first = run[0]
        return compat.read_toml(first["scene"]) if "scene" in first else {}
    except (ImportError, ValueError):  # a stream may have any text there
        return {}
    except sheetstream.StreamError as error:
        raise SheetError(str(error)) from error


def _upright(described: dict[str, Any], up: str) -> Matrix:
    """The rotation that turns the run's up into Blender's, z."""
    axis = Vector((0, 0, 1))
    if up != "AUTO":
        axis = Vector([float(letter == up) for letter in "XYZ"])
    else:
        try:
            gravity = Vector([float(g) for g in described["environment"]["gravity"]])
            axis = -gravity.normalized() if gravity.length > 0 else axis
        except (KeyError, TypeError, ValueError):  # none; a stream may have any text for a scene
            pass
    return axis.rotation_difference(Vector((0, 0, 1))).to_matrix().to_4x4()


def _refresh(self: Any, context: Any) -> None:
    if self.file and isinstance(self.id_data, bpy.types.Object) and self.id_data.type == "MESH":
        update_object(self.id_data, context.scene)


class SheetSettings(bpy.types.PropertyGroup):
    """What an imported object follows."""
    file: bpy.props.StringProperty(name="File", subtype="FILE_PATH", update=_refresh)  # type: ignore[valid-type]
    start: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="First frame", description="Blender's frame that shows the run's first", default=1, update=_refresh)
    speed: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Speed", description="Seconds of the run that pass in a second", default=1.0, min=1e-6, update=_refresh)
    between: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Move between frames", description="Vertices go on between the run's frames", default=True,
        update=_refresh)
    first_time: bpy.props.FloatProperty(name="Time of the first frame", unit="TIME")  # type: ignore[valid-type]
    mesh_file: bpy.props.StringProperty()  # type: ignore[valid-type] # of its scene
    number: bpy.props.IntProperty(default=-1)  # type: ignore[valid-type] # of the run's sheet; -1: all that it has
    by_liquid: bpy.props.BoolProperty()  # type: ignore[valid-type] # each liquid has a material
    drops: bpy.props.PointerProperty(type=bpy.types.Object)  # type: ignore[valid-type] # which shows those of the run
    message: bpy.props.StringProperty()  # type: ignore[valid-type]
