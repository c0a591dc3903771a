# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheets of a scene: their meshes (.ply), and the tables that speak of them."""
from __future__ import annotations

import pathlib
from typing import Any

import bpy
import numpy as np

from . import carried
from .errors import SheetError
from .evaluated import Thickness, Triangles, painted_groups, surface_of, thickness_of, triangles_of
from .holds import MOST_HOLDS, hold_tables, inflow_table, quoted
from .movement import changes_shape, motion_of, moves, write_rows
from .plan import Material, Plan, SheetPlan, Written
from .ply_file import write_ply

ALIKE = 1.4  # edges whose lengths differ by more are not those of one mesh


def material_lines(table: str, material: Material) -> list[str]:
    lines = [f"[{table}]", f"viscosity = {material.viscosity!r}", f"density = {material.density!r}"]
    return lines + ([f"surface_tension = {material.surface_tension!r}"] if material.surface_tension > 0 else [])


class SheetTables:
    """What the sheets of a plan are in the scene's text: `sheets` come first, `behind` what acts on them."""

    def __init__(self, target: pathlib.Path, plan: Plan, written: Written) -> None:
        self.target, self.plan, self.written = target, plan, written
        self.sheets: list[str] = []
        self.behind: list[str] = []
        self.holds = 0
        self.several = len(plan.sheets) > 1
        self.names = _names_of(plan.sheets)
        self.inlets = sum(bool(sheet.inlet) for sheet in plan.sheets)
        self.edges = common_edges(plan)
        self._tell_of_edges()
        inflows: list[str] = []
        lengths = []
        for number in range(len(plan.sheets)):
            inflow, edge = self._add(number)
            inflows += inflow
            lengths.append(edge)
        if self.holds > MOST_HOLDS:
            raise SheetError(f"{self.holds} vertex groups are holds, a scene has {MOST_HOLDS} at most: join some of"
                             " them")
        self.behind += inflows
        if not self.edges:
            self._tell_of_lengths(lengths)

    def mesh_file(self, number: int) -> pathlib.Path:
        return mesh_file_of(self.target, number, self.several)

    def _tell_of_edges(self) -> None:
        sheets = self.plan.sheets
        if self.edges and any(sheet.edges != self.edges for sheet in sheets):
            name = next(sheet.thing.name for sheet in sheets if sheet.edges == self.edges)
            self.written.told.append("all sheets have edges of one length: they are split as those of"
                                     f' "{name}" are, which are shortest (Sheet > Edges)')

    def _tell_of_lengths(self, lengths: list[float]) -> None:
        if self.several and max(lengths) > ALIKE * min(lengths):
            fine, coarse = (self.plan.sheets[lengths.index(f(lengths))].thing.name for f in (min, max))
            self.written.told.append(f'edges of "{coarse}" are {max(lengths) / min(lengths):.2g} times as long as those'
                                     f' of "{fine}": the run soon gives all sheets edges of the mean length; set Sheet'
                                     " > Edges to choose one")

    def _add(self, number: int) -> tuple[list[str], float]:
        """Writes one sheet; returns the lines of its inflow, and how long its edges are [m]."""
        sheet, mesh_file = self.plan.sheets[number], self.mesh_file(number)
        thing, length = sheet.thing, bpy.context.scene.unit_settings.scale_length
        with surface_of(thing, self.edges) as mesh:
            shape = triangles_of(mesh, thing.matrix_world, length)
            thickness = thickness_of(mesh, shape.face)
            groups = painted_groups(thing, mesh, sheet.groups, shape.triangle)
            at_vertices, at_triangles, layers = carried.collect(mesh, shape)
            lost = carried.left_out(mesh)
        self.written.files.append(str(mesh_file))
        missing = [name for name in sheet.groups if name not in groups]
        if missing:
            raise SheetError(f'"{thing.name}" has no vertex group "{missing[0]}": choose another one in the panel')
        if self.several:
            at_triangles[carried.SHEET] = np.full(len(shape.triangle), number, np.int32)
        self._add_table(number, thickness, [*at_vertices, *at_triangles])
        self._tell(sheet, thickness, lost)
        motion = self._motion(sheet, mesh_file)
        of = f"sheet = {quoted(self.names[number])}" if self.several else ""
        held = {name: groups[name] for name in sheet.holds}
        lines, arrays = hold_tables(held, sheet.holds, motion, self.holds, of)
        self.behind += lines
        self.holds += len(held)
        at_vertices |= arrays
        inflow: list[str] = []
        if sheet.inlet:
            inflow, entry = inflow_table(sheet.inlet, groups[sheet.inlet], shape.position, shape.triangle,
                                         sheet.inlet_speed, sheet.thickness, self.inlets > 1, of)
            at_vertices |= entry
        if layers:
            carried.keep(mesh_file, layers, shape)
            self.written.files.append(str(carried.file_of(mesh_file)))
        else:  # of another state
            carried.file_of(mesh_file).unlink(missing_ok=True)
        write_ply(mesh_file, shape, thickness, at_vertices, at_triangles | carried.corner_arrays(layers))
        return inflow, _mean_edge(shape)

    def _add_table(self, number: int, thickness: Thickness | None, kept: list[str]) -> None:
        sheet = self.plan.sheets[number]
        head = ["[[sheet]]", f"name = {quoted(self.names[number])}"] if self.several else ["[sheet]"]
        self.sheets += head + ['shape = "mesh"', f"file = {quoted(self.mesh_file(number).name)}",
                               f"thickness = {_thickness_value(sheet, thickness)}"]
        if kept:
            self.sheets.append("arrays = [" + ", ".join(quoted(name) for name in kept) + "]")
        if self.several and sheet.material is not None:
            self.sheets += material_lines("sheet.material", sheet.material)
        self.sheets.append("")

    def _motion(self, sheet: SheetPlan, mesh_file: pathlib.Path) -> str:
        """The motion of the sheet's holds: that of the object, if it moves."""
        thing, told = sheet.thing, self.written.told
        if changes_shape(thing, bpy.context.scene):
            told.append(f'"{thing.name}" changes its shape from frame to frame: the run begins with what it is at its'
                        " first frame, and its holds do not follow the shape")
        rows = motion_of(thing, bpy.context.scene)
        if not moves(rows):
            return ""
        if not sheet.holds:
            told.append(f'"{thing.name}" moves, and nothing of it is held: the run begins where it is at its first'
                        " frame, at rest; what shall move with the object must be in a vertex group that is pinned or"
                        " clamped")
            return ""
        file = mesh_file.with_suffix(".csv")
        write_rows(file, rows)
        self.written.files.append(str(file))
        return f'{{kind = "keyframed", file = {quoted(file.name)}}}'

    def _tell(self, sheet: SheetPlan, thickness: Thickness | None, lost: list[str]) -> None:
        idle = [group.name for group in sheet.thing.vertex_groups if group.name not in sheet.groups]
        if idle:
            self.written.told.append(
                f'vertex group "{idle[0]}"' + (f" and {len(idle) - 1} more hold" if len(idle) > 1 else " holds") +
                ' nothing: names that begin with "pinned" or "clamped" do, and those that the panel names')
        if lost:
            more = f" and {len(lost) - 1} more do" if len(lost) > 1 else " does"
            self.written.told.append(f'attribute "{lost[0]}" of "{sheet.thing.name}"{more} not come back: those of'
                                     " numbers or vectors at vertices do")
        attributes = getattr(sheet.thing.data, "attributes", {})
        if thickness is None and "thickness" in attributes:
            self.written.told.append(f'"{sheet.thing.name}": its attribute "thickness" is not taken: it must be a Float'
                                     " at vertices or faces (Object Data > Attributes)")


def common_edges(plan: Plan) -> float:
    """The shortest that a sheet asks for, for all of them: remeshing knows one length. 0: each as it is."""
    return min((sheet.edges for sheet in plan.sheets if sheet.edges > 0), default=0.0)


def mesh_file_of(target: pathlib.Path, number: int, several: bool) -> pathlib.Path:
    """The mesh file of a sheet, beside the scene."""
    return target.with_name(f"{target.stem}_sheet_{number}.ply") if several else target.with_suffix(".ply")


def _names_of(sheets: list[SheetPlan]) -> list[str]:
    """The objects' names; those of linked files, which may be alike, with numbers."""
    names: list[str] = []
    for sheet in sheets:
        name, n = sheet.thing.name, 1
        while name in names:
            name, n = f"{sheet.thing.name} {n}", n + 1
        names.append(name)
    return names


def _thickness_value(sheet: SheetPlan, thickness: Thickness | None) -> str:
    if thickness is None:
        return repr(sheet.thickness)
    values, place = thickness
    if not values.min() > 0:
        bad = int(values.argmin())
        raise SheetError(f'"{sheet.thing.name}": attribute "thickness" is {values[bad]:g} at {place} {bad}; '
                         "it must be positive")
    return f'{{data = "thickness", place = "{place}"}}'


def _mean_edge(shape: Triangles) -> float:
    corners: Any = shape.position[shape.triangle]
    return float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())
