# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheet in Blender (3.4 and later): runs as meshes that change with time, and scenes made of meshes.

File > Import > Sheet run (.sheet) or Sheet bodies (.ply) and File > Export > Sheet scene (.toml); docs/blender.md is
the page. It reads streams by the package sheetstream, which lies beside it in the zip file that the build makes. In
scripts:

    import sheet_blender
    thing = sheet_blender.import_run("run.sheet", material="honey")
    thing = sheet_blender.import_bodies("body_0000.ply", material="honey", up="Y")
    sheet_blender.export_scene("scene.toml", thing, thickness=0.005)
"""
from __future__ import annotations

import math
import os
import pathlib
import subprocess
from typing import Any

import bmesh
import bpy
import numpy as np
from bpy.app.handlers import persistent
from bpy_extras.io_utils import ExportHelper, ImportHelper
from mathutils import Matrix, Quaternion, Vector

try:
    from . import body_files, sheetstream
except ImportError:
    try:
        import body_files  # type: ignore[no-redef]
        import sheetstream  # type: ignore[no-redef]
    except ImportError as error:
        raise ImportError("Sheet's add-on needs the package sheetstream: install sheet-blender.zip, which has it, or"
                          " put "
                          "the folder formats/python on PYTHONPATH") from error

bl_info = {
    "name": "Sheet: thin viscous sheets",
    "author": "the authors of Sheet",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import, File > Export, Object properties > Sheet",
    "description": "Imports runs as meshes that change with time, exports scenes with painted holds",
    "category": "Import-Export",
}

OPAQUE = 1000  # scattering [1/m] from which a few millimetres hide what is behind
THICKNESS_LOOK = "thickness"
MOST_HOLDS = 64


class SheetError(Exception):
    """What is wrong with a file or an object, for the user."""


def _listed(name: str, *command: str) -> list[list[str]]:
    """The rows that a program lists, by their columns: in the zip file the build has put them beside this file; else
    the program is asked."""
    beside = pathlib.Path(__file__).with_name(name)
    text = beside.read_text(encoding="utf-8") if beside.exists() else subprocess.run(
        command, capture_output=True, text=True, check=True).stdout
    return [line.split("\t") for line in text.splitlines()]


# {key of a scene: (kind, SI unit, help)}.
SCENE_KEYS = {key: (kind, unit, help_line)
              for key, kind, unit, help_line in _listed("scene_keys.tsv", "sheet-init", "--list-keys")}
# sheet-render's presets: index of refraction, absorption and reduced scattering for red, green, blue [1/m].
LIQUIDS = {name: (float(index), tuple(map(float, absorption.split())), tuple(map(float, scattering.split())))
           for name, index, absorption, scattering in _listed("liquids.tsv", "sheet-render", "--list-liquids")}
HOLD_KINDS = tuple(SCENE_KEYS["hold.N.kind"][0].split("|"))


def _key_property(key: str, **more: Any) -> Any:
    """A number that the user gives for a key of the scene: its name, unit and help are those of the key."""
    _, unit, help_line = SCENE_KEYS[key]
    name = key.split(".")[-1].capitalize()
    return bpy.props.FloatProperty(name=f"{name} [{unit}]", description=help_line, min=1e-9, **more)


# ---- runs

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


def fill_body(mesh: bpy.types.Mesh, body: body_files.Body, ahead: float, velocity_scale: float = 1.0) -> None:
    """Makes the mesh that of the body, gone on for the time `ahead` [s] with its velocity; its arrays are attributes of
    their names."""
    velocity = body.arrays.get("velocity", np.zeros_like(body.position))
    if len(mesh.vertices) != len(body.position) or not _has_triangles(mesh, body.triangle):
        _set_triangles(mesh, len(body.position), body.triangle)
    mesh.vertices.foreach_set("co", (body.position + ahead * velocity).astype(np.float32).ravel())
    for name, values in (body.arrays | {"velocity": velocity_scale * velocity}).items():
        _set_attribute(mesh, name, "FLOAT_VECTOR" if values.ndim == 2 else "FLOAT", "POINT", values)
    mesh.update()


def fill_mesh(mesh: bpy.types.Mesh, frame: sheetstream.Frame, position: Any, velocity_scale: float = 1.0) -> None:
    """Makes the mesh that of the frame, with the attributes thickness, triangle_thickness, velocity, slab and touch."""
    corners = frame["triangle"]
    if len(mesh.vertices) != frame.vertices or not _has_triangles(mesh, corners):
        _set_triangles(mesh, frame.vertices, corners)
    mesh.vertices.foreach_set("co", position.astype(np.float32).ravel())
    thickness = frame.vertex_thickness()
    _set_attribute(mesh, "thickness", "FLOAT", "POINT", thickness)
    _set_attribute(mesh, "triangle_thickness", "FLOAT", "FACE", frame.thickness())
    _set_attribute(mesh, "velocity", "FLOAT_VECTOR", "POINT", velocity_scale * frame.velocity())
    _set_attribute(mesh, "slab", "FLOAT_VECTOR", "POINT", frame.vertex_normals() * (thickness / 2)[:, None])
    touch = (np.asarray(frame["touch"]).reshape(frame.vertices, -1) != 0).any(axis=1) if "touch" in frame else None
    _set_attribute(mesh, "touch", "FLOAT", "POINT", np.zeros(frame.vertices) if touch is None else touch)
    mesh.update()


def _has_triangles(mesh: bpy.types.Mesh, corners: Any) -> bool:
    if len(mesh.polygons) != len(corners) or len(mesh.loops) != corners.size:
        return False
    now = np.empty(corners.size, np.int32)
    mesh.loops.foreach_get("vertex_index", now)
    return np.array_equal(now, corners.ravel())


def _set_triangles(mesh: bpy.types.Mesh, vertices: int, corners: Any) -> None:
    mesh.clear_geometry()
    mesh.vertices.add(vertices)
    mesh.loops.add(corners.size)
    mesh.polygons.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners.astype(np.int32).ravel())
    mesh.polygons.foreach_set("loop_start", np.arange(0, corners.size, 3, dtype=np.int32))
    if not bpy.types.MeshPolygon.bl_rna.properties["loop_total"].is_readonly:  # it follows from loop_start since 4.0
        mesh.polygons.foreach_set("loop_total", np.full(len(corners), 3, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(corners), bool))
    mesh.update(calc_edges=True)


def _set_attribute(mesh: bpy.types.Mesh, name: str, kind: str, domain: str, values: Any) -> None:
    attribute = mesh.attributes.get(name)
    if attribute is not None and (attribute.data_type, attribute.domain) != (kind, domain):
        mesh.attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = mesh.attributes.new(name, kind, domain)
    attribute.data.foreach_set("vector" if kind == "FLOAT_VECTOR" else "value", np.asarray(values, np.float32).ravel())


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
    fill_mesh(thing.data, frame, position, settings.speed)
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


def import_run(path: str, material: str = "caramel", up: str = "AUTO", start: int = 1, speed: float = 1.0,
               between: bool = True, slab: bool = True, solids: bool = True, adapt_scene: bool = True,
               scene: bpy.types.Scene | None = None) -> bpy.types.Object:
    """Adds a run to the scene as an object whose mesh follows the time; returns it. Raises SheetError.

    Blender's frame `start` shows the run's first frame; `speed` seconds of the run pass in a second. up: the run's axis
    that points upwards (X, Y, Z, or AUTO: against the gravity of its scene).
    """
    scene = scene or bpy.context.scene
    run = open_run(path)
    described = _scene_of(run)
    thing = _add_object(path, _upright(described, up), run.times, start, speed, between, scene)
    if slab:
        add_slab(thing)
    set_material(thing, material, scene)
    if adapt_scene:
        _adapt_scene(thing, run.times, scene)
    if solids:
        add_solids(described, thing, scene)
    _show_first(thing, scene)
    return thing


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
    set_material(thing, material, scene)
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


def _scene_of(run: sheetstream.Run) -> dict[str, Any]:
    try:
        return run[0].scene()
    except (ImportError, ValueError):  # Python 3.10 has no reader of TOML; a stream may have any text there
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


# ---- the slab, by geometry nodes


def add_slab(thing: bpy.types.Object) -> bpy.types.Modifier:
    """Gives the object the modifier that shows both sides of the sheet and its rim, at half the thickness from it."""
    modifier = thing.modifiers.new("Sheet slab", "NODES")
    modifier.node_group = slab_group()
    return modifier


def slab_group() -> bpy.types.NodeTree:
    """The node group of the slab, made once a file. Its input "Factor" makes the slab thicker than it is."""
    name = "Sheet slab"
    if name in bpy.data.node_groups:
        return bpy.data.node_groups[name]
    tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
    _add_socket(tree, "Geometry", "INPUT", "NodeSocketGeometry")
    factor = _add_socket(tree, "Factor", "INPUT", "NodeSocketFloat")
    factor.default_value, factor.min_value = 1.0, 0.0
    _add_socket(tree, "Geometry", "OUTPUT", "NodeSocketGeometry")
    link = tree.links.new
    entry, leave = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    named = tree.nodes.new("GeometryNodeInputNamedAttribute")
    named.data_type = "FLOAT_VECTOR"
    named.inputs["Name"].default_value = "slab"
    slab = next(s for s in named.outputs if s.enabled and s.type == "VECTOR")

    def scaled(by: float) -> Any:
        multiply, scale = tree.nodes.new("ShaderNodeMath"), tree.nodes.new("ShaderNodeVectorMath")
        multiply.operation, scale.operation = "MULTIPLY", "SCALE"
        link(entry.outputs["Factor"], multiply.inputs[0])
        multiply.inputs[1].default_value = by
        link(slab, scale.inputs[0])
        link(multiply.outputs[0], scale.inputs["Scale"])
        return scale.outputs["Vector"]

    def moved(geometry: Any, by: float, selection: Any = None) -> Any:
        node = tree.nodes.new("GeometryNodeSetPosition")
        link(geometry, node.inputs["Geometry"])
        link(scaled(by), node.inputs["Offset"])
        if selection is not None:
            link(selection, node.inputs["Selection"])
        return node.outputs["Geometry"]

    rim = tree.nodes.new("GeometryNodeExtrudeMesh")
    rim.mode = "EDGES"
    neighbours = tree.nodes.new("GeometryNodeInputMeshEdgeNeighbors")
    alone = tree.nodes.new("FunctionNodeCompare")
    alone.data_type, alone.operation = "INT", "EQUAL"
    link(neighbours.outputs[0], [s for s in alone.inputs if s.type == "INT"][0])
    [s for s in alone.inputs if s.type == "INT"][1].default_value = 1
    link(moved(entry.outputs["Geometry"], 1), rim.inputs["Mesh"])
    link(alone.outputs[0], rim.inputs["Selection"])
    rim.inputs["Offset Scale"].default_value = 0.0
    flip = tree.nodes.new("GeometryNodeFlipFaces")
    link(moved(entry.outputs["Geometry"], -1), flip.inputs[0])
    join = tree.nodes.new("GeometryNodeJoinGeometry")
    link(flip.outputs[0], join.inputs[0])
    link(moved(rim.outputs["Mesh"], -2, rim.outputs["Top"]), join.inputs[0])
    link(join.outputs[0], leave.inputs["Geometry"])
    for i, node in enumerate(tree.nodes):
        node.location = (200 * (i % 6), -220 * (i // 6))
    return tree


def _add_socket(tree: bpy.types.NodeTree, name: str, side: str, kind: str) -> Any:
    if hasattr(tree, "interface"):  # since 4.0
        return tree.interface.new_socket(name, in_out=side, socket_type=kind)
    return (tree.inputs if side == "INPUT" else tree.outputs).new(kind, name)


# ---- materials


def body_colour(absorption: tuple[float, ...], scattering: tuple[float, ...]) -> list[float]:
    """What a thick layer throws back [Kubelka and Munk 1931] with internal reflection [Saunderson 1942], as in
    sheet-render."""
    result = []
    for a, s in zip(absorption, scattering):
        ratio = 2 * a / (0.75 * s)
        deep = 1 + ratio - math.sqrt(ratio * ratio + 2 * ratio)
        result.append((1 - 0.6) * deep / (1 - 0.6 * deep))
    return result


def make_material(kind: str) -> bpy.types.Material:
    """The material of a preset, or false colours of the thickness; made once a file."""
    name = f"Sheet {kind}"
    if name in bpy.data.materials:
        return bpy.data.materials[name]
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, link = material.node_tree.nodes, material.node_tree.links.new
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    if kind == THICKNESS_LOOK:
        link(_false_colours(material.node_tree), output.inputs["Surface"])
        return material
    index, absorption, scattering = LIQUIDS[kind]
    opaque = min(scattering) >= OPAQUE
    colour = (*body_colour(absorption, scattering), 1) if opaque else (1, 1, 1, 1)
    material.diffuse_color = colour if opaque else (*(math.exp(-0.003 * a) for a in absorption), 1)
    if opaque:
        surface = nodes.new("ShaderNodeBsdfPrincipled")
        surface.inputs["Base Color"].default_value = colour
        surface.inputs["Roughness"].default_value = 0.15
        surface.inputs["IOR"].default_value = index
    else:
        surface = nodes.new("ShaderNodeBsdfGlass")
        surface.inputs["Roughness"].default_value = 0.0
        surface.inputs["IOR"].default_value = index
        link(_volume(material.node_tree, absorption, scattering), output.inputs["Volume"])
    link(surface.outputs["BSDF"], output.inputs["Surface"])
    return material


def _volume(tree: bpy.types.NodeTree, absorption: tuple[float, ...], scattering: tuple[float, ...]) -> Any:
    """Absorption (1 - colour) density and scattering colour density [1/m]."""
    most = max(absorption)
    absorb = tree.nodes.new("ShaderNodeVolumeAbsorption")
    absorb.inputs["Color"].default_value = (*(1 - a / most for a in absorption), 1)
    absorb.inputs["Density"].default_value = most
    if max(scattering) == 0:
        return absorb.outputs["Volume"]
    scatter = tree.nodes.new("ShaderNodeVolumeScatter")
    scatter.inputs["Color"].default_value = (*(s / max(scattering) for s in scattering), 1)
    scatter.inputs["Density"].default_value = max(scattering)
    both = tree.nodes.new("ShaderNodeAddShader")
    tree.links.new(absorb.outputs["Volume"], both.inputs[0])
    tree.links.new(scatter.outputs["Volume"], both.inputs[1])
    return both.outputs[0]


def _false_colours(tree: bpy.types.NodeTree) -> Any:
    """sheet-render's colours; the scale is that of the node "Scale", from 0 to 10 mm until it is set."""
    attribute, scale = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeMapRange")
    attribute.attribute_name = "thickness"
    scale.name = scale.label = "Scale"
    scale.inputs["From Min"].default_value, scale.inputs["From Max"].default_value = 0.0, 0.01
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    stops = sheetstream.QUANTITIES["thickness"].stops
    elements = ramp.color_ramp.elements
    while len(elements) < len(stops):
        elements.new(0.5)
    for element, (place, *colour) in zip(elements, stops):
        element.position = place
        element.color = (*(((c + 0.055) / 1.055)**2.4 if c > 0.04045 else c / 12.92 for c in colour), 1)
    matte = tree.nodes.new("ShaderNodeBsdfDiffuse")
    tree.links.new(attribute.outputs["Fac"], scale.inputs["Value"])
    tree.links.new(scale.outputs["Result"], ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], matte.inputs["Color"])
    return matte.outputs["BSDF"]


def set_material(thing: bpy.types.Object, kind: str, scene: bpy.types.Scene) -> None:
    """Gives the object a preset's material, and Cycles enough bounces to see through it."""
    if kind not in (*LIQUIDS, THICKNESS_LOOK):
        raise SheetError(f'material "{kind}" is unknown: choose {", ".join((*LIQUIDS, THICKNESS_LOOK))}')
    thing.data.materials.clear()
    thing.data.materials.append(make_material(kind))
    if kind in LIQUIDS and min(LIQUIDS[kind][2]) < OPAQUE and hasattr(scene, "cycles"):
        scene.cycles.volume_bounces = max(scene.cycles.volume_bounces, 4)
        scene.cycles.transmission_bounces = max(scene.cycles.transmission_bounces, 12)


# ---- solids of the scene


def add_solids(described: dict[str, Any], parent: bpy.types.Object, scene: bpy.types.Scene) -> None:
    """Adds the scene's balls, boxes, cylinders, capsules, planes and meshes (OFF) in their places at time 0, as the
    parent's children; motion at a constant velocity or by rows is keyed. Others are passed over, with a word on the
    terminal."""
    solids = described.get("solid", [])
    for number, solid in enumerate(solids if isinstance(solids, list) else []):
        try:
            _add_solid(solid, number, parent, scene)
        except (KeyError, TypeError, ValueError, AttributeError, OSError) as error:
            print(f"Sheet: {parent.name}: solid {number} is passed over: {error}")


def _add_solid(solid: dict[str, Any], number: int, parent: bpy.types.Object, scene: bpy.types.Scene) -> None:
    mesh = _solid_mesh(solid, parent.sheet.file)
    thing = bpy.data.objects.new(f"{parent.name} {solid['shape']} {number}", mesh)
    scene.collection.objects.link(thing)
    thing.parent = parent
    turn = solid.get("rotation", {})
    if turn:
        thing.rotation_mode = "AXIS_ANGLE"
        thing.rotation_axis_angle = (turn["angle"], *turn["axis"])
    thing.location = solid.get("center", (0, 0, 0))
    if solid.get("motion", {}).get("kind") == "keyframed":
        _key_rows(thing, solid["motion"], parent.sheet, scene)
        return
    velocity = solid.get("motion", {}).get("velocity", [0, 0, 0])
    if np.shape(velocity) == (3,) and any(velocity):
        _key_motion(thing, np.array(velocity, float), parent.sheet, scene)


def _key_rows(thing: bpy.types.Object, motion: dict[str, Any], settings: Any, scene: bpy.types.Scene) -> None:
    """A key for each row; between them on straight lines, which the run's motion leaves by little."""
    times = motion["times"]
    still = [motion.get("center", (0, 0, 0))] * len(times)
    frames = [Matrix.LocRotScale(Vector(place), Quaternion(turn), None) for place, turn in
              zip(motion.get("places", still), motion.get("rotations", [(1, 0, 0, 0)] * len(times)))]
    first = next((i for i, time in enumerate(times) if time >= 0), -1)
    if times[first] > 0 and first > 0:
        raise ValueError("its motion has no row at time 0")
    own = frames[first].inverted() @ thing.matrix_basis
    rate = scene.render.fps / scene.render.fps_base
    thing.rotation_mode = "QUATERNION"
    for time, frame in zip(times, frames):
        thing.location, turn, _ = (frame @ own).decompose()
        turn.make_compatible(thing.rotation_quaternion)
        thing.rotation_quaternion = turn
        at = settings.start + (time - settings.first_time) / settings.speed * rate
        thing.keyframe_insert("location", frame=at)
        thing.keyframe_insert("rotation_quaternion", frame=at)
    for curve in thing.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def _key_motion(thing: bpy.types.Object, velocity: Any, settings: Any, scene: bpy.types.Scene) -> None:
    rate = scene.render.fps / scene.render.fps_base
    origin = np.array(thing.location)
    for frame in (settings.start, settings.start + 1000):
        time = settings.first_time + (frame - settings.start) / rate * settings.speed
        thing.location = origin + velocity * time
        thing.keyframe_insert("location", frame=frame)
    for curve in thing.animation_data.action.fcurves:
        curve.extrapolation = "LINEAR"
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def _solid_mesh(solid: dict[str, Any], run_file: str) -> bpy.types.Mesh:
    shape = solid["shape"]
    if shape == "mesh" and solid["file"].endswith(".off"):
        return _read_off(solid, run_file)
    made = bmesh.new()
    if shape == "sphere":
        bmesh.ops.create_icosphere(made, subdivisions=5, radius=solid["radius"])
    elif shape == "box":
        bmesh.ops.create_cube(made, size=1.0)
        bmesh.ops.scale(made, vec=solid["size"], verts=made.verts)
    elif shape == "cylinder":
        bmesh.ops.create_cone(made, cap_ends=True, segments=96, radius1=solid["radius"], radius2=solid["radius"],
                              depth=solid["height"])
        bmesh.ops.rotate(made, matrix=Matrix.Rotation(math.pi / 2, 3, "X"), verts=made.verts)  # stands along y
    elif shape == "capsule":
        bmesh.ops.create_uvsphere(made, u_segments=64, v_segments=32, radius=solid["radius"])
        bmesh.ops.rotate(made, matrix=Matrix.Rotation(math.pi / 2, 3, "X"), verts=made.verts)  # stands along y
        bmesh.ops.translate(made, vec=(0, solid["length"] / 2, 0), verts=[v for v in made.verts if v.co.y > 1e-9])
        bmesh.ops.translate(made, vec=(0, -solid["length"] / 2, 0), verts=[v for v in made.verts if v.co.y < -1e-9])
    elif shape == "plane":
        bmesh.ops.create_grid(made, x_segments=1, y_segments=1, size=50.0)
        turn = Vector((0, 0, 1)).rotation_difference(Vector(solid.get("normal", (0, 0, 1))))
        bmesh.ops.rotate(made, matrix=turn.to_matrix(), verts=made.verts)
    else:
        made.free()
        raise ValueError(f"its shape is not drawn here: {shape}")
    mesh = bpy.data.meshes.new(f"Sheet {shape}")
    made.to_mesh(mesh)
    made.free()
    if shape in ("sphere", "capsule"):
        mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    return mesh


def _read_off(solid: dict[str, Any], run_file: str) -> bpy.types.Mesh:
    """A mesh of triangles in OFF, beside the run or above it, with or without the folders of its name."""
    folder = pathlib.Path(bpy.path.abspath(run_file)).resolve().parent
    name = pathlib.Path(solid["file"])
    places = [place / part for place in (folder, *folder.parents) for part in (name, name.name)]
    found = next((place for place in places if place.is_file()), None)
    if found is None:
        raise ValueError(f"{name} is neither beside the run nor above it")
    numbers = " ".join(line.split("#")[0] for line in found.read_text().splitlines()).split()
    if len(numbers) < 4 or numbers[0] != "OFF":
        raise ValueError(f"{found} does not begin with OFF")
    points, faces = int(numbers[1]), int(numbers[2])
    x = np.array(numbers[4:4 + 3 * points], float).reshape(-1, 3) * solid.get("scale", 1.0)
    corners = np.array(numbers[4 + 3 * points:4 + 3 * points + 4 * faces], int).reshape(-1, 4)
    if (corners[:, 0] != 3).any() or corners.min() < 0 or corners[:, 1:].max() >= points:
        raise ValueError(f"{found} has other faces than triangles of its vertices")
    mesh = bpy.data.meshes.new("Sheet mesh")
    mesh.from_pydata(x.tolist(), [], corners[:, 1:].tolist())
    mesh.polygons.foreach_set("use_smooth", np.ones(faces, bool))
    return mesh


# ---- scenes


def export_scene(path: str, thing: bpy.types.Object, thickness: float = 0.005, viscosity: float = 80.0,
                 density: float = 1300.0, solids: tuple[bpy.types.Object, ...] = ()) -> list[str]:
    """Writes an object's mesh, modifiers applied, as a scene (.toml) with its mesh beside it (.ply); returns the files.

    Thickness [m] is that of the mesh's attribute of this name, at vertices or faces, if it has one. Vertex groups whose
    names begin with "pinned" or "clamped" become holds: vertices with a weight above 0.5. Other objects become solids;
    those that move from the scene's frame on do so in the run, whose time 0 this frame is, by a file (.csv). Raises
    SheetError.
    """
    if thing is None or thing.type != "MESH":
        raise SheetError("choose a mesh: the active object is none")
    target = pathlib.Path(path)
    length = bpy.context.scene.unit_settings.scale_length
    x, corners, mesh_thickness, groups = _evaluated(thing, length)
    if not len(corners):
        raise SheetError(f'"{thing.name}" has no faces: a sheet is made of triangles')
    files = [str(target), str(target.with_suffix(".ply"))]
    given = "vertex" if mesh_thickness is not None and len(mesh_thickness) == len(x) else "face"
    if mesh_thickness is not None and not mesh_thickness.min() > 0:
        bad = int(mesh_thickness.argmin())
        raise SheetError(f'"{thing.name}": attribute "thickness" is {mesh_thickness[bad]:g} at {given} {bad}; '
                         "it must be positive")
    _write_ply(files[1], x, corners, mesh_thickness)
    lines = [f"# made by Blender of {_quoted(thing.name)}", "[sheet]", 'shape = "mesh"',
             f"file = {_quoted(pathlib.Path(files[1]).name)}",
             f"thickness = {thickness!r}" if mesh_thickness is None else
             f'thickness = {{data = "thickness", place = "{given}"}}', "",
             "[material]", f"viscosity = {viscosity!r}", f"density = {density!r}", "",
             "[environment]", "gravity = [0, 0, -9.81]"]
    lines += _hold_tables(x, corners, groups)
    for number, solid in enumerate(solids):
        file = target.with_name(f"{target.stem}_solid_{number}.ply")
        sx, sc, _, _ = _evaluated(solid, length)
        _write_ply(str(file), sx, sc, None)
        files.append(str(file))
        lines += ["", "[[solid]]", 'shape = "mesh"', f"file = {_quoted(file.name)}"]
        rows = motion_of(solid, bpy.context.scene)
        if (np.abs(rows[:, 1:] - rows[0, 1:]) > 1e-7).any():
            file = file.with_suffix(".csv")
            _write_rows(file, rows)
            files.append(str(file))
            lines += ["center = [0, 0, 0] # the mesh stands where it is at time 0",
                      "rotation = {axis = [0, 0, 1], angle = 0}",
                      f'motion = {{kind = "keyframed", file = {_quoted(file.name)}}}']
    target.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return files


def motion_of(thing: bpy.types.Object, scene: bpy.types.Scene) -> Any:
    """How an object moves from the scene's frame to its last: rows of time [s], place [m] and rotation (a unit
    quaternion w, x, y, z), one a frame. Raises SheetError if its size changes."""
    now, rate, length = scene.frame_current, scene.render.fps / scene.render.fps_base, scene.unit_settings.scale_length
    rows = []
    try:
        for frame in range(now, max(scene.frame_end, now) + 1):
            scene.frame_set(frame)
            place, turn, scale = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.decompose()
            size = scale if frame == now else size
            if (scale - size).length > 1e-4 * size.length:
                raise SheetError(f'"{thing.name}" changes its size at frame {frame}: solids move, but stay as they are')
            rows.append(((frame - now) / rate, *(length * place), *turn))
    finally:
        scene.frame_set(now)
    return np.array(rows)


def export_motion(path: str, thing: bpy.types.Object) -> None:
    """Writes an object's motion from the scene's frame on (motion_of) as a file (.csv) for scenes: motion = {kind =
    "keyframed", file = "..."}. Raises SheetError."""
    _write_rows(pathlib.Path(path), motion_of(thing, bpy.context.scene))


def _write_rows(path: pathlib.Path, rows: Any) -> None:
    lines = ["time [s], x [m], y [m], z [m], qw, qx, qy, qz", *(", ".join(repr(float(v)) for v in row) for row in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _quoted(text: str) -> str:
    """A TOML string of one line."""
    shown = "".join(c if c.isprintable() else "?" for c in text)
    return '"' + shown.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _evaluated(thing: bpy.types.Object, length: float) -> tuple[Any, Any, Any, dict[str, Any]]:
    """Vertices [m], triangles, thickness or None, and the painted vertices of each group that is a hold."""
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    try:
        mesh.calc_loop_triangles()
        x, corners = np.empty(3 * len(mesh.vertices)), np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.vertices.foreach_get("co", x)
        mesh.loop_triangles.foreach_get("vertices", corners)
        faces = np.empty(len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("polygon_index", faces)
        matrix = np.array(thing.matrix_world)
        world = (x.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]) * length
        triangles = corners.reshape(-1, 3)
        if np.linalg.det(matrix[:3, :3]) < 0:
            triangles = triangles[:, ::-1]
        groups = {group.index: group.name for group in thing.vertex_groups if group.name.lower().startswith(HOLD_KINDS)}
        painted = {name: np.zeros(len(world), bool) for name in groups.values()}
        for vertex in mesh.vertices if groups else ():
            for membership in vertex.groups:
                if membership.group in groups and membership.weight > 0.5:
                    painted[groups[membership.group]][vertex.index] = True
        return world, triangles, _thickness_of(mesh, faces), painted
    finally:
        evaluated.to_mesh_clear()


def _thickness_of(mesh: bpy.types.Mesh, faces: Any) -> Any:
    attribute = mesh.attributes.get("thickness")
    if attribute is None or attribute.data_type != "FLOAT" or attribute.domain not in ("POINT", "FACE"):
        return None
    values = np.empty(len(attribute.data))
    attribute.data.foreach_get("value", values)
    return values if attribute.domain == "POINT" else values[faces]


def _write_ply(path: str, x: Any, corners: Any, thickness: Any) -> None:
    at_vertex = thickness is not None and len(thickness) == len(x)
    vertex = np.zeros(len(x), [("x", "<f8", 3)] + ([("thickness", "<f8")] if at_vertex else []))
    face = np.zeros(len(corners), [("count", "u1"), ("corners", "<i4", 3)] +
                    ([("thickness", "<f8")] if thickness is not None and not at_vertex else []))
    vertex["x"], face["count"], face["corners"] = x, 3, corners
    if thickness is not None:
        (vertex if at_vertex else face)["thickness"] = thickness
    extra = "property double thickness\n"
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(x)}\nproperty double x\nproperty double y\nproperty double z\n"
              f"{extra if at_vertex else ''}element face {len(corners)}\nproperty list uchar int vertex_indices\n"
              f"{extra if 'thickness' in (face.dtype.names or ()) else ''}end_header\n")
    with open(path, "wb") as file:
        file.write(header.encode() + vertex.tobytes() + face.tobytes())


def _hold_tables(x: Any, corners: Any, groups: dict[str, Any]) -> list[str]:
    """[[hold]] tables whose regions hold exactly the painted vertices: the whole rim, or boxes."""
    lines: list[str] = []
    rim = _rim_vertices(corners, len(x))
    total = 0
    for name, painted in groups.items():
        if not painted.any():
            raise SheetError(f'vertex group "{name}" holds nothing: no vertex has a weight above 0.5')
        kind = next(k for k in HOLD_KINDS if name.lower().startswith(k))
        if np.array_equal(painted, rim):
            regions = ['"rim"']
        else:
            regions = [f"{{box = [{_row(low)}, {_row(high)}]}}" for low, high in painted_boxes(x, painted)]
        total += len(regions)
        for region in regions:
            lines += ["", f"[[hold]] # {_quoted(name)}", f"region = {region}", f'kind = "{kind}"']
    if total > MOST_HOLDS:
        raise SheetError(f"what is painted takes {total} boxes, a scene has {MOST_HOLDS} holds at most: paint areas"
                         f" whose "
                         "borders follow the axes, or the whole rim")
    return lines


def _row(values: Any) -> str:
    return "[" + ", ".join(repr(float(v)) for v in values) + "]"


def _rim_vertices(corners: Any, vertices: int) -> Any:
    sides = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    edges, counts = np.unique(sides, axis=0, return_counts=True)
    result = np.zeros(vertices, bool)
    result[edges[counts == 1].ravel()] = True
    return result


def painted_boxes(x: Any, painted: Any) -> list[tuple[Any, Any]]:
    """Few boxes that hold all painted points and no others: each is divided, where least remains wrong, until it is
    right."""
    margin = 1e-7 * max(float(np.ptp(x, axis=0).max()), 1e-30)
    others = x[~painted]

    def box(points: Any) -> tuple[Any, Any]:
        return points.min(axis=0) - margin, points.max(axis=0) + margin

    def wrong(points: Any) -> int:
        low, high = box(points)
        return int(((others >= low) & (others <= high)).all(axis=1).sum())

    result, waiting = [], [x[painted]]
    while waiting:
        points = waiting.pop()
        if wrong(points) == 0 or len(np.unique(points, axis=0)) == 1:
            result.append(box(points))
            continue
        best = None
        for axis in range(3):
            values = np.unique(points[:, axis])
            for place in np.unique(np.linspace(1, len(values) - 1, 16).round().astype(int)) if len(values) > 1 else ():
                part = points[:, axis] < values[place]
                left = wrong(points[part]) + wrong(points[~part])
                if best is None or left < best[0]:
                    best = (left, part)
        assert best is not None
        waiting += [points[best[1]], points[~best[1]]]
        if len(result) + len(waiting) > 4 * MOST_HOLDS:
            raise SheetError(f"what is painted takes more than {MOST_HOLDS} boxes: paint areas whose borders follow"
                             f" the "
                             "axes, or the whole rim")
    return result


# ---- what Blender shows


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
    message: bpy.props.StringProperty()  # type: ignore[valid-type]


def _material_items() -> list[tuple[str, str, str]]:
    return [(name, name.capitalize(), "as sheet-render's" if name in LIQUIDS else "false colours")
            for name in (*LIQUIDS, THICKNESS_LOOK)]


def _select(thing: bpy.types.Object, context: Any) -> None:
    for other in context.selected_objects:
        other.select_set(False)
    thing.select_set(True)
    context.view_layer.objects.active = thing


class SHEET_OT_import(bpy.types.Operator, ImportHelper):
    """Import a run of Sheet as a mesh that changes with time"""
    bl_idname = "sheet.import_run"
    bl_label = "Import Sheet run"
    bl_options = {"REGISTER", "UNDO"}
    filename_ext = ".sheet"
    filter_glob: bpy.props.StringProperty(default="*.sheet", options={"HIDDEN"})  # type: ignore[valid-type]
    material: bpy.props.EnumProperty(name="Material", items=_material_items(),
                                     default="caramel")  # type: ignore[valid-type]
    up: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Up", items=[("AUTO", "As gravity says", ""), *((a, a, "") for a in "XYZ")], default="AUTO")
    start: bpy.props.IntProperty(name="First frame", default=1)  # type: ignore[valid-type]
    speed: bpy.props.FloatProperty(name="Speed", default=1.0, min=1e-6)  # type: ignore[valid-type]
    between: bpy.props.BoolProperty(name="Move between frames", default=True)  # type: ignore[valid-type]
    slab: bpy.props.BoolProperty(name="Slab of true thickness", default=True)  # type: ignore[valid-type]
    solids: bpy.props.BoolProperty(name="Solids", default=True)  # type: ignore[valid-type]
    adapt_scene: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Adapt the scene", description="Its last frame, metric units, a locked interface while rendering",
        default=True)

    def execute(self, context: Any) -> set[str]:
        try:
            thing = import_run(self.filepath, self.material, self.up, self.start, self.speed, self.between, self.slab,
                               self.solids, self.adapt_scene, context.scene)
        except SheetError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        _select(thing, context)
        return {"FINISHED"}


class SHEET_OT_import_bodies(bpy.types.Operator, ImportHelper):
    """Import the files of sheet-export --union as one mesh that changes with time"""
    bl_idname = "sheet.import_bodies"
    bl_label = "Import Sheet bodies"
    bl_options = {"REGISTER", "UNDO"}
    filename_ext = ".ply"
    filter_glob: bpy.props.StringProperty(default="*.ply", options={"HIDDEN"})  # type: ignore[valid-type]
    material: bpy.props.EnumProperty(name="Material", items=_material_items(),
                                     default="caramel")  # type: ignore[valid-type]
    up: bpy.props.EnumProperty(name="Up", items=[(a, a, "") for a in "XYZ"], default="Y")  # type: ignore[valid-type]
    start: bpy.props.IntProperty(name="First frame", default=1)  # type: ignore[valid-type]
    speed: bpy.props.FloatProperty(name="Speed", default=1.0, min=1e-6)  # type: ignore[valid-type]
    between: bpy.props.BoolProperty(name="Move between frames", default=True)  # type: ignore[valid-type]
    adapt_scene: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Adapt the scene", description="Its last frame, metric units, a locked interface while rendering",
        default=True)

    def execute(self, context: Any) -> set[str]:
        try:
            thing = import_bodies(self.filepath, self.material, self.up, self.start, self.speed, self.between,
                                  self.adapt_scene, context.scene)
        except SheetError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        _select(thing, context)
        return {"FINISHED"}


class SHEET_OT_export(bpy.types.Operator, ExportHelper):
    """Export the active mesh as a scene of Sheet: vertex groups "pinned..." and "clamped..." are holds"""
    bl_idname = "sheet.export_scene"
    bl_label = "Export Sheet scene"
    filename_ext = ".toml"
    filter_glob: bpy.props.StringProperty(default="*.toml", options={"HIDDEN"})  # type: ignore[valid-type]
    thickness: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Thickness", description='Where the mesh has no attribute "thickness"', default=0.005, min=1e-9,
        unit="LENGTH")
    viscosity: _key_property("material.viscosity", default=80.0)  # type: ignore[valid-type]
    density: _key_property("material.density", default=1300.0)  # type: ignore[valid-type]
    solids: bpy.props.BoolProperty(name="Other selected meshes are solids", default=True)  # type: ignore[valid-type]

    def execute(self, context: Any) -> set[str]:
        active = context.view_layer.objects.active
        others = tuple(o for o in context.selected_objects if o is not active
                       and o.type == "MESH") if self.solids else ()
        try:
            files = export_scene(self.filepath, active, self.thickness, self.viscosity, self.density, others)
        except (SheetError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, "Written: " + ", ".join(files))
        return {"FINISHED"}


class SHEET_PT_object(bpy.types.Panel):
    """What run an object follows, and how."""
    bl_label = "Sheet"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "object"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return context.object is not None and context.object.type == "MESH" and bool(context.object.sheet.file)

    def draw(self, context: Any) -> None:
        for name in ("file", "start", "speed", "between"):
            self.layout.prop(context.object.sheet, name)
        message = context.object.sheet.message
        self.layout.label(text=message, icon="ERROR" if message.startswith("Error") else "INFO")


def _import_entry(self: Any, _context: Any) -> None:
    self.layout.operator(SHEET_OT_import.bl_idname, text="Sheet run (.sheet)")
    self.layout.operator(SHEET_OT_import_bodies.bl_idname, text="Sheet bodies (.ply)")


def _export_entry(self: Any, _context: Any) -> None:
    self.layout.operator(SHEET_OT_export.bl_idname, text="Sheet scene (.toml)")


CLASSES = (SheetSettings, SHEET_OT_import, SHEET_OT_import_bodies, SHEET_OT_export, SHEET_PT_object)


def register() -> None:
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.sheet = bpy.props.PointerProperty(type=SheetSettings)
    bpy.types.TOPBAR_MT_file_import.append(_import_entry)
    bpy.types.TOPBAR_MT_file_export.append(_export_entry)
    bpy.app.handlers.frame_change_pre.append(on_frame_change)


def unregister() -> None:
    bpy.app.handlers.frame_change_pre.remove(on_frame_change)
    bpy.types.TOPBAR_MT_file_export.remove(_export_entry)
    bpy.types.TOPBAR_MT_file_import.remove(_import_entry)
    del bpy.types.Object.sheet
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
