# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of Blender as a scene of Sheet: a text (.toml) with meshes (.ply) and motions (.csv) beside it."""
from __future__ import annotations

import pathlib
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import bpy
import numpy as np

from . import carried
from .errors import SheetError
from .evaluated import WITH_SURFACE, Triangles, painted_groups, surface_of, thickness_of, triangles_of
from .holds import hold_tables, inflow_table, kind_of, quoted, row

MOVED = 1e-7  # [m] or of a unit quaternion: less is rest
FREE_FALL = 9.81  # [m/s²]


@dataclass
class Plan:
    """What a scene is made of. Lengths in metres, but for `edges` [Blender's units]; 0: as the mesh has them."""
    sheet: bpy.types.Object
    thickness: float = 0.005
    edges: float = 0.0
    viscosity: float = 80.0  # [Pa s]
    density: float = 1300.0  # [kg/m³]
    surface_tension: float = 0.0  # [N/m]
    self_contact: bool = True
    solids: list[tuple[bpy.types.Object, str]] = field(default_factory=list)  # with their contact
    holds: dict[str, str] = field(default_factory=dict)  # {vertex group: kind}
    inlet: str = ""  # vertex group
    inlet_speed: float = 0.1  # [m/s]


class Written(NamedTuple):
    """files: what was written; told: what the scene has not of what Blender shows, in words for the user."""
    files: list[str]
    told: list[str]


def holds_by_name(thing: bpy.types.Object) -> dict[str, str]:
    return {group.name: kind for group in thing.vertex_groups if (kind := kind_of(group.name))}


def export_scene(path: str, thing: bpy.types.Object, thickness: float = 0.005, viscosity: float = 80.0,
                 density: float = 1300.0, solids: tuple[bpy.types.Object, ...] = (),
                 surface_tension: float = 0.0) -> list[str]:
    """Writes an object's mesh, modifiers applied, as a scene (.toml) with its mesh beside it (.ply); returns the files.

    Thickness [m] is that of the mesh's attribute of this name, at vertices or faces, if it has one. Vertex groups whose
    names begin with "pinned" or "clamped" become holds: vertices with a weight above 0.5, which move as the object
    does. Other objects become solids; those that move from the scene's frame on do so in the run, whose time 0 this
    frame is, by a file (.csv). UV maps, colours and materials go along (carried.py). What of all this the scene cannot
    have is told on the terminal. Raises SheetError.
    """
    if thing is None:
        raise SheetError("choose a mesh: the active object is none")
    plan = Plan(thing, thickness, viscosity=viscosity, density=density, surface_tension=surface_tension,
                solids=[(solid, "stick") for solid in solids], holds=holds_by_name(thing))
    written = write_scene(path, plan)
    for line in written.told:
        print(f"Sheet: {line}")
    return written.files


def write_scene(path: str, plan: Plan) -> Written:
    """Writes the scene at the scene's frame, which is time 0 of the run. Raises SheetError, OSError."""
    target = pathlib.Path(path)
    scene = bpy.context.scene
    length = scene.unit_settings.scale_length
    files, told = [str(target)], list(told_of_scene(scene))
    lines = [f"# made by Blender of {quoted(plan.sheet.name)}"]
    lines += _write_sheet(target, plan, length, files, told)
    for number, (solid, contact) in enumerate(plan.solids):
        file = target.with_name(f"{target.stem}_solid_{number}.ply")
        lines += _write_solid(file, solid, contact, length, files, told)
    target.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return Written(files, told)


def plain(value: float) -> float:
    """A number that Blender has in single precision, as a user would write it."""
    return float(f"{value:.7g}")


def gravity_of(scene: bpy.types.Scene) -> Any:
    """[m/s²], as Blender shows it in its units; 0 if the scene has none."""
    return np.array([plain(g * scene.unit_settings.scale_length) for g in scene.gravity]) * scene.use_gravity


def told_of_scene(scene: bpy.types.Scene) -> list[str]:
    told = []
    strength = float(np.linalg.norm(gravity_of(scene)))
    if scene.use_gravity and scene.unit_settings.scale_length != 1 and not 0.5 < strength / FREE_FALL < 2:
        right = FREE_FALL / scene.unit_settings.scale_length
        told.append(f"gravity is {strength:.4g} m/s² at this unit scale: for the Earth's set Scene > Gravity such that"
                    f" it shows 9.81 m/s² ({right:.5g} in Python)")
    fields = [thing.name for thing in scene.objects if thing.field and thing.field.type != "NONE"]
    if fields:
        told.append(f'force fields do not act on the sheet: "{fields[0]}"' + (" and others" if len(fields) > 1 else ""))
    return told


def _write_sheet(target: pathlib.Path, plan: Plan, length: float, files: list[str], told: list[str]) -> list[str]:
    thing, mesh_file = plan.sheet, target.with_suffix(".ply")
    with surface_of(thing, plan.edges) as mesh:
        shape = triangles_of(mesh, thing.matrix_world, length)
        thickness = thickness_of(mesh, shape.face)
        groups = painted_groups(thing, mesh, [*plan.holds, *([plan.inlet] if plan.inlet else [])])
        at_vertices, at_triangles, layers = carried.collect(mesh, shape)
    files.append(str(mesh_file))
    missing = [name for name in (*plan.holds, *([plan.inlet] if plan.inlet else [])) if name not in groups]
    if missing:
        raise SheetError(f'"{thing.name}" has no vertex group "{missing[0]}": choose another one in the panel')
    kept = [*at_vertices, *at_triangles]
    lines = ["[sheet]", 'shape = "mesh"', f"file = {quoted(mesh_file.name)}",
             f"thickness = {_thickness_value(thing, thickness, plan.thickness, len(shape.position))}"]
    if kept:
        lines.append("arrays = [" + ", ".join(quoted(name) for name in kept) + "]")
    lines += ["", "[material]", f"viscosity = {plan.viscosity!r}", f"density = {plan.density!r}"]
    if plan.surface_tension > 0:
        lines.append(f"surface_tension = {plan.surface_tension!r}")
    gravity = gravity_of(bpy.context.scene)
    if gravity.any():
        lines += ["", "[environment]", f"gravity = {row(gravity)}"]
    if plan.self_contact:
        lines += ["", "[contact]", "self = true"]
    motion = _sheet_motion(target, plan, files, told)
    held = {name: groups[name] for name in plan.holds}
    hold_lines, hold_arrays = hold_tables(held, plan.holds, motion)
    lines += hold_lines
    at_vertices |= hold_arrays
    if plan.inlet:
        inflow, entry = inflow_table(plan.inlet, groups[plan.inlet], shape.position, shape.triangle, plan.inlet_speed,
                                     plan.thickness)
        lines += inflow
        at_vertices |= entry
    _tell_of_groups(plan, told)
    if layers:
        carried.keep(mesh_file, layers, shape)
        files.append(str(carried.file_of(mesh_file)))
    else:  # of another state
        carried.file_of(mesh_file).unlink(missing_ok=True)
    _write_ply(mesh_file, shape, thickness, at_vertices, at_triangles)
    return lines


def _thickness_value(thing: bpy.types.Object, values: Any, uniform: float, vertices: int) -> str:
    if values is None:
        return repr(uniform)
    given = "vertex" if len(values) == vertices else "face"
    if not values.min() > 0:
        bad = int(values.argmin())
        raise SheetError(f'"{thing.name}": attribute "thickness" is {values[bad]:g} at {given} {bad}; '
                         "it must be positive")
    return f'{{data = "thickness", place = "{given}"}}'


def _sheet_motion(target: pathlib.Path, plan: Plan, files: list[str], told: list[str]) -> str:
    """The motion of the sheet's holds: that of the object, if it moves."""
    thing = plan.sheet
    if changes_shape(thing, bpy.context.scene):
        told.append(f'"{thing.name}" changes its shape from frame to frame: the run begins with what it is at its first'
                    " frame, and its holds do not follow the shape")
    rows = motion_of(thing, bpy.context.scene)
    if not _moves(rows):
        return ""
    if not plan.holds:
        told.append(f'"{thing.name}" moves, and nothing of it is held: the run begins where it is at its first frame,'
                    " at rest; what shall move with the object must be in a vertex group that is pinned or clamped")
        return ""
    file = target.with_suffix(".csv")
    _write_rows(file, rows)
    files.append(str(file))
    return f'{{kind = "keyframed", file = {quoted(file.name)}}}'


def _tell_of_groups(plan: Plan, told: list[str]) -> None:
    used = {*plan.holds, plan.inlet}
    idle = [group.name for group in plan.sheet.vertex_groups if group.name not in used]
    if idle:
        told.append(f'vertex group "{idle[0]}"' + (f" and {len(idle) - 1} more hold" if len(idle) > 1 else " holds") +
                    ' nothing: names that begin with "pinned" or "clamped" do, and those that the panel names')


def _write_solid(file: pathlib.Path, solid: bpy.types.Object, contact: str, length: float, files: list[str],
                 told: list[str]) -> list[str]:
    with surface_of(solid) as mesh:
        shape = triangles_of(mesh, solid.matrix_world, length)
    _write_ply(file, shape, None, {}, {})
    files.append(str(file))
    lines = ["", f"[[solid]] # {quoted(solid.name)}", 'shape = "mesh"', f"file = {quoted(file.name)}"]
    if contact != "stick":
        lines.append(f'contact = "{contact}"')
    if changes_shape(solid, bpy.context.scene):
        told.append(f'"{solid.name}" changes its shape from frame to frame: solids move, but keep the shape of the'
                    " first frame")
    rows = motion_of(solid, bpy.context.scene)
    if _moves(rows):
        file = file.with_suffix(".csv")
        _write_rows(file, rows)
        files.append(str(file))
        lines += ["center = [0, 0, 0] # the mesh stands where it is at time 0",
                  "rotation = {axis = [0, 0, 1], angle = 0}",
                  f'motion = {{kind = "keyframed", file = {quoted(file.name)}}}']
    return lines


def _moves(rows: Any) -> bool:
    return bool((np.abs(rows[:, 1:] - rows[0, 1:]) > MOVED).any())


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


def changes_shape(thing: bpy.types.Object, scene: bpy.types.Scene) -> bool:
    """Whether an object has another shape, in its own frame, at the scene's last frame or halfway there than now."""
    data = thing.data
    if thing.type not in WITH_SURFACE or not (thing.modifiers or getattr(data, "shape_keys", None) or
                                              data.animation_data):
        return False
    now = scene.frame_current
    shapes = []
    try:
        for frame in sorted({now, (now + scene.frame_end) // 2, max(now, scene.frame_end)}):
            scene.frame_set(frame)
            with surface_of(thing) as mesh:
                x = np.empty(3 * len(mesh.vertices), np.float32)
                mesh.vertices.foreach_get("co", x)
                shapes.append(x)
    finally:
        scene.frame_set(now)
    first = shapes[0]
    size = max(float(np.ptp(first.reshape(-1, 3), axis=0).max()), 1e-30)
    return any(len(x) != len(first) or float(np.abs(x - first).max()) > 1e-5 * size for x in shapes[1:])


def export_motion(path: str, thing: bpy.types.Object) -> None:
    """Writes an object's motion from the scene's frame on (motion_of) as a file (.csv) for scenes: motion = {kind =
    "keyframed", file = "..."}. Raises SheetError."""
    _write_rows(pathlib.Path(path), motion_of(thing, bpy.context.scene))


def _write_rows(path: pathlib.Path, rows: Any) -> None:
    lines = ["time [s], x [m], y [m], z [m], qw, qx, qy, qz", *(", ".join(repr(float(v)) for v in r) for r in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _ply_columns(arrays: dict[str, Any]) -> list[tuple[str, str, Any]]:
    """Properties of PLY, by name, type and values: name, or name_0, name_1, ... of several components."""
    columns = []
    for name, values in arrays.items():
        kind = "uchar" if values.dtype == np.uint8 else "int" if values.dtype.kind == "i" else "double"
        parts = [(name, values)] if values.ndim == 1 else \
            [(f"{name}_{k}", values[:, k]) for k in range(values.shape[1])]
        columns += [(part, kind, column) for part, column in parts]
    return columns


def _write_ply(path: pathlib.Path, shape: Triangles, thickness: Any, at_vertices: dict[str, Any],
               at_triangles: dict[str, Any]) -> None:
    """One object's triangles, with thickness at vertices or triangles, and other arrays."""
    if thickness is not None:
        place = at_vertices if len(thickness) == len(shape.position) else at_triangles
        place["thickness"] = thickness
    numpy_types = {"uchar": "u1", "int": "<i4", "double": "<f8"}
    of_vertex, of_face = _ply_columns(at_vertices), _ply_columns(at_triangles)
    vertex = np.zeros(len(shape.position), [("x", "<f8", 3), *((n, numpy_types[k]) for n, k, _ in of_vertex)])
    face = np.zeros(len(shape.triangle), [("count", "u1"), ("corners", "<i4", 3),
                                          *((n, numpy_types[k]) for n, k, _ in of_face)])
    vertex["x"], face["count"], face["corners"] = shape.position, 3, shape.triangle
    for table, columns in ((vertex, of_vertex), (face, of_face)):
        for name, _, values in columns:
            table[name] = values
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertex)}",
              *(f"property double {axis}" for axis in "xyz"), *(f"property {k} {n}" for n, k, _ in of_vertex),
              f"element face {len(face)}", "property list uchar int vertex_indices",
              *(f"property {k} {n}" for n, k, _ in of_face), "end_header\n"]
    path.write_bytes("\n".join(header).encode() + vertex.tobytes() + face.tobytes())
