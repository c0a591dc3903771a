# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of Blender as a scene of Sheet: a text (.toml) with meshes (.ply) and motions (.csv) beside it."""
from __future__ import annotations

import pathlib
from typing import Any

import bpy
import numpy as np

from .errors import SheetError
from .holds import quoted, row
from .left_out import told_of_things
from .plan import Material, Plan, SheetPlan, Written, holds_by_name, plain
from .sheet_tables import SheetTables, material_lines
from .solid_tables import write_solid

FREE_FALL = 9.81  # [m/s²]


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
    plan = Plan([SheetPlan(thing, thickness, holds=holds_by_name(thing))],
                Material(viscosity, density, surface_tension), solids=[(solid, "stick") for solid in solids])
    written = write_scene(path, plan)
    for line in written.told:
        print(f"Sheet: {line}")
    return written.files


def write_scene(path: str, plan: Plan) -> Written:
    """Writes the scene at the scene's frame, which is time 0 of the run. Raises SheetError, OSError."""
    target = pathlib.Path(path)
    scene = bpy.context.scene
    written = Written([str(target)], told_of_scene(scene) + told_of_things(plan))
    tables = SheetTables(target, plan, written)
    lines = ["# made by Blender of " + ", ".join(quoted(sheet.thing.name) for sheet in plan.sheets), *tables.sheets]
    lines += _common_tables(plan, written.told)
    lines += tables.behind
    for number, (solid, contact) in enumerate(plan.solids):
        file = target.with_name(f"{target.stem}_solid_{number}.ply")
        lines += write_solid(file, solid, contact, plan, written)
    target.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return written


def _common_tables(plan: Plan, told: list[str]) -> list[str]:
    """Of the liquid, of gravity and of contact."""
    own = plan.sheets[0].material if len(plan.sheets) == 1 else None
    lines = [] if all(sheet.material for sheet in plan.sheets) and not own else \
        material_lines("material", own or plan.material)
    gravity = gravity_of(bpy.context.scene)
    if gravity.any():
        lines += ["", "[environment]", f"gravity = {row(gravity)}"]
    if plan.self_contact:
        lines += ["", "[contact]", "self = true"]
    elif len(plan.sheets) > 1:
        told.append("sheets pass through each other: Self Contact (Liquid) keeps them apart, too")
    return lines


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
    if scene.render.frame_map_old != scene.render.frame_map_new:
        told.append("what is animated follows Time Stretching (Output > Frame Range), and the run follows the frames:"
                    " set Old and New alike")
    fields = [thing.name for thing in scene.objects if thing.field and thing.field.type != "NONE"]
    if fields:
        told.append(f'force fields do not act on the sheet: "{fields[0]}"' + (" and others" if len(fields) > 1 else ""))
    return told
