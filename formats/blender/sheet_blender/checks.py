# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with the scene, in plain words: faults of the sheets' meshes with Blender's own remedies, the faulty
elements selected, what the scene cannot have, and what sheet-init --check says."""
from __future__ import annotations

import pathlib
import re
import subprocess
import tempfile
import textwrap
from typing import Any, NamedTuple

import bmesh
import bpy
import numpy as np

from .errors import SheetError
from .evaluated import surface_of, triangles_of
from .parts import plan_of, things_with, times_of
from .plan import Plan, SheetPlan
from .programs import environment, find_program
from .sheet_tables import common_edges
from .simulate import write_here

TEXT = "Sheet check"  # the text block that keeps what the last check said
WIDTH = 90  # of a popup [characters]


class Fault(NamedTuple):
    """what, with Blender's remedy; of whose mesh; kind: verts, edges, faces; elements: their numbers in the mesh."""
    thing: bpy.types.Object
    what: str
    kind: str
    elements: list[int]


def faults_of(thing: bpy.types.Object) -> list[Fault]:
    """What keeps a mesh from being a sheet."""
    if thing.type != "MESH":
        return []
    made = bmesh.new()
    try:
        made.from_mesh(thing.data)
        return [Fault(thing, *found) for found in _found(made) if found[2]]
    finally:
        made.free()


def _found(made: Any) -> list[tuple[str, str, list[int]]]:
    crowded = [e.index for e in made.edges if len(e.link_faces) > 2]
    turned = [e.index for e in made.edges if len(e.link_faces) == 2 and not e.is_contiguous]
    flat = [f.index for f in made.faces if f.calc_area() == 0]
    loose = [v.index for v in made.verts if not v.link_faces]
    pinched = [v.index for v in made.verts if v.link_faces and not v.is_manifold and not v.is_wire and
               all(len(e.link_faces) <= 2 for e in v.link_edges)]
    return [(f"{_counted(crowded, 'edge')} of more than two faces: a sheet has two sides. Delete the faces that do"
             " not belong to it, or separate them (Mesh > Separate > Selection)", "edges", crowded),
            (f"{_counted(turned, 'edge')} between faces that look to different sides: Mesh > Normals > Recalculate"
             " Outside", "edges", turned),
            (f"{_counted(flat, 'face')} without area: Mesh > Clean Up > Degenerate Dissolve", "faces", flat),
            (f"{_counted(pinched, 'vertex', 'vertices')} in which parts of the sheet touch in a point: Mesh >"
             " Split > Faces by Edges, or fill the gap", "verts", pinched),
            (f"{_counted(loose, 'vertex', 'vertices')} without faces are left out: Mesh > Clean Up > Delete Loose",
             "verts", loose)]


def _counted(elements: list[int], one: str, many: str = "") -> str:
    return f"{len(elements)} {one if len(elements) == 1 else many or one + 's'}"


REMEDIES = ((r"starts inside|starts across", "move the sheet or the solid in Object Mode (G)"),
            (r"nothing joins them|has \d+ pieces", "Mesh > Merge > By Distance in Edit Mode"),
            (r"has no area|sharp|needles", "Mesh > Clean Up > Degenerate Dissolve, or the modifier Remesh"),
            (r"same direction|orientation|normals|face outward|inside out",
             "Mesh > Normals > Recalculate Outside in Edit Mode"),
            (r"closed surface has at least", "give it a thickness (modifier Solidify)"),
            (r"not closed|open edges|watertight|has a border",
             "Mesh > Fill, or Mesh > Clean Up > Fill Holes, in Edit Mode"),
            (r"not a manifold|more than two", "Select > Select All by Trait > Non Manifold in Edit Mode shows where"))


def with_remedy(line: str) -> str:
    """A line of sheet-init, with what to do about it in Blender if that is known."""
    remedy = next((remedy for pattern, remedy in REMEDIES if re.search(pattern, line)), "")
    return f"{line}. In Blender: {remedy}" if remedy else line


def named_elements(line: str, sheets: list[SheetPlan], edges: float) -> Fault | None:
    """The vertex or triangle that a line of sheet-init names, in the mesh of its object; None if there is none, or
    modifiers make the sheet's mesh another one. The sheets lie one behind the other, and a line that names the file of
    one counts in that alone. edges: as they are split to."""
    match = re.search(r"\b(vertex|triangle) (\d+)\b", line)
    if match is None or "solid" in line[:match.start()].split(":")[-1] and "starts" not in line:
        return None
    number, file = int(match[2]), re.search(r"scene_sheet_(\d+)\.ply", line)
    for sheet in sheets[int(file[1]):] if file else sheets:
        with surface_of(sheet.thing, edges) as mesh:
            shape = triangles_of(mesh, sheet.thing.matrix_world, 1.0)
            in_mesh = shape.face if match[1] == "triangle" else np.unique(shape.triangle)  # loose vertices do not go
            if number < len(in_mesh):
                own = sheet.thing.data
                if len(mesh.vertices) != len(own.vertices) or len(mesh.polygons) != len(own.polygons):
                    return None
                kind = "faces" if match[1] == "triangle" else "verts"
                return Fault(sheet.thing, line, kind, [int(in_mesh[number])])
            number -= len(in_mesh)
    return None


def select(fault: Fault) -> None:
    """Shows the elements in Edit Mode, and nothing else selected."""
    view, thing = bpy.context.view_layer, fault.thing
    if view.objects.active is not None and view.objects.active.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    thing.hide_set(False)
    for other in view.objects:
        other.select_set(other is thing)
    view.objects.active = thing
    mesh = thing.data
    for data in (mesh.vertices, mesh.edges, mesh.polygons):
        data.foreach_set("select", [False] * len(data))
    data = {"verts": mesh.vertices, "edges": mesh.edges, "faces": mesh.polygons}[fault.kind]
    for number in fault.elements:
        data[number].select = True
        for vertex in () if fault.kind == "verts" else data[number].vertices:
            mesh.vertices[vertex].select = True
    bpy.context.tool_settings.mesh_select_mode = [fault.kind == kind for kind in ("verts", "edges", "faces")]
    bpy.ops.object.mode_set(mode="EDIT")


class Report(NamedTuple):
    """wrong: what prevents a run; told: what a user should know; explained: all that sheet-init --check says."""
    wrong: list[str]
    told: list[str]
    explained: str
    fault: Fault | None


def check(scene: bpy.types.Scene) -> Report:
    """Everything that can be said before a run. Raises SheetError, OSError."""
    plan = plan_of(scene)
    faults = [fault for sheet in plan.sheets for fault in faults_of(sheet.thing)]
    wrong = [_whose(fault, plan) for fault in faults if "are left out" not in fault.what]
    told = [_whose(fault, plan) for fault in faults if "are left out" in fault.what]
    for solid in things_with("SOLID", scene):
        told += [f'"{solid.name}": {fault.what}' for fault in faults_of(solid)]
    if wrong:
        return Report(wrong, told, "", faults[0])
    rate, until = times_of(scene)
    with tempfile.TemporaryDirectory() as folder:
        told += write_here(pathlib.Path(folder), scene).told
        done = subprocess.run(
            [find_program("sheet-init"), "--check", "--quality", scene.sheet_run.quality, "--until", repr(until),
             "--fps", repr(rate), "scene.toml"], cwd=folder, env=environment(), capture_output=True, text=True)
    if done.returncode != 0:
        said = [_in_names(re.sub(r"^(sheet-init: )?(error: )?(scene\.toml(:\d+)*: )?", "", line.strip()), scene)
                for line in done.stderr.splitlines() if line.strip()]
        edges = common_edges(plan)
        fault = next((f for line in said if (f := named_elements(line, plan.sheets, edges)) is not None), None)
        return Report([with_remedy(line) for line in said], told, done.stdout, fault)
    section = re.search(r"^Warnings\n((?:  .*\n)+)", done.stdout, re.M)
    items = re.findall(r"^  (\S.*(?:\n   +\S.*)*)", section[1], re.M) if section else []
    told += [with_remedy(_in_names(" ".join(item.split()), scene)) for item in items]
    return Report([], told, done.stdout, faults[0] if faults else None)


def _whose(fault: Fault, plan: Plan) -> str:
    return f'"{fault.thing.name}": {fault.what}' if len(plan.sheets) > 1 else fault.what


def _in_names(line: str, scene: bpy.types.Scene) -> str:
    """The solids by the names that Blender has for them."""
    for number, solid in enumerate(things_with("SOLID", scene)):
        line = re.sub(rf"\bsolid {number}( \([^)]*\))?(?!\d)", lambda _, name=solid.name: f'"{name}"', line)
    return line


def keep_text(report: Report) -> None:
    text = bpy.data.texts.get(TEXT) or bpy.data.texts.new(TEXT)
    text.clear()
    text.write("\n".join([*report.wrong, *report.told, "", report.explained]))


class SHEET_OT_check(bpy.types.Operator):
    """Say what a run would model, and what is wrong; faulty elements are selected"""
    bl_idname = "sheet.check"
    bl_label = "Check the Sheet"

    def execute(self, context: Any) -> set[str]:
        try:
            report = check(context.scene)
        except (SheetError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        keep_text(report)
        if report.fault is not None:
            select(report.fault)
        if not bpy.app.background:
            _pop_up(report)
        for line in report.told:
            self.report({"WARNING"}, line)
        for line in report.wrong:
            self.report({"ERROR"}, line)
        return {"CANCELLED"} if report.wrong else {"FINISHED"}


def _pop_up(report: Report) -> None:
    def draw(self: Any, _context: Any) -> None:
        for icon, lines in (("ERROR", report.wrong), ("INFO", report.told)):
            for line in lines:
                for i, part in enumerate(textwrap.wrap(line, WIDTH)):
                    self.layout.label(text=part, icon=icon if i == 0 else "BLANK1")
        if not report.wrong:
            for line in _summary(report.explained):
                self.layout.label(text=line, icon="CHECKMARK" if not report.told else "BLANK1")
        self.layout.label(text=f'All of it is in the text "{TEXT}"', icon="TEXT")

    title = "Not yet: this must be mended" if report.wrong else "It can be simulated"
    bpy.context.window_manager.popup_menu(draw, title=title, icon="ERROR" if report.wrong else "CHECKMARK")


def _summary(explained: str) -> list[str]:
    """What is to be expected of the run."""
    found = re.search(r"To expect: (.*?)(?:\. Most|$)", " ".join(explained.split()))
    return textwrap.wrap(f"To expect: {found[1]}", WIDTH) if found else []


CLASSES = (SHEET_OT_check,)
