# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands in the properties: of an object that follows a run, and of the simulation in the tab Physics."""
from __future__ import annotations

import textwrap
from typing import Any

import bmesh
import bpy

from . import cache
from .compat import draw_socket, progress
from .errors import SheetError
from .evaluated import WITH_SURFACE
from .parts import role_of, sheets_of, things_with, times_of
from .plan import holds_by_name
from .scene_file import told_of_scene
from .simulate import duration, words_of
from .slab import FACTOR, GROUP

COLUMNS = 46  # of a message in a panel of the usual width [characters]


def _message(layout: Any, text: str, icon: str) -> None:
    column = layout.column(align=True)
    for i, line in enumerate(textwrap.wrap(text, COLUMNS)):
        column.label(text=line, icon=icon if i == 0 else "BLANK1")


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
        slab = next((m for m in context.object.modifiers if m.type == "NODES" and m.node_group and
                     m.node_group.name == GROUP), None)
        if slab is not None:
            draw_socket(self.layout, slab, FACTOR)
        message = context.object.sheet.message
        self.layout.label(text=message, icon="ERROR" if message.startswith("Error") else "INFO")


class SHEET_PT_part(bpy.types.Panel):
    """Which part an object has in the simulation."""
    bl_label = "Sheet"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "physics"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return context.object is not None and context.object.type in WITH_SURFACE

    def draw(self, context: Any) -> None:
        thing, layout = context.object, self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        if thing.sheet.file:
            layout.label(text="Shows a run", icon="INFO")
            return
        layout.prop(thing.sheet_part, "role")
        if thing.sheet_part.role == "AUTO":
            for collection in thing.users_collection:
                layout.prop(collection.sheet_collection, "role", text=collection.name)
        role = role_of(thing)
        if role == "SOLID":
            layout.prop(thing.sheet_part, "contact")
        if role == "SHEET":
            layout.prop(thing.sheet_part, "thickness")
            layout.prop(thing.sheet_part, "edges")


class SHEET_PT_held(bpy.types.Panel):
    """What is held of the sheet, and where liquid enters."""
    bl_label, bl_parent_id = "Held and Entering", "SHEET_PT_part"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "physics"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return not context.object.sheet.file and role_of(context.object) == "SHEET"

    def draw(self, context: Any) -> None:
        thing, layout = context.object, self.layout
        part = thing.sheet_part
        layout.use_property_split, layout.use_property_decorate = True, False
        for name in ("pinned", "clamped", "inlet"):
            layout.prop_search(part, name, thing, "vertex_groups")
        if part.inlet:
            layout.prop(part, "inlet_speed")
        by_name = [f"{group} ({kind})" for group, kind in holds_by_name(thing).items()
                   if group not in (part.pinned, part.clamped)]
        if by_name:
            _message(layout, "By their names: " + ", ".join(by_name), "INFO")
        row = layout.row(align=True)
        row.enabled = thing.mode == "EDIT"
        for kind in ("pinned", "clamped", "inlet"):
            row.operator("sheet.from_selection", text=kind.capitalize()).kind = kind
        if not row.enabled:
            layout.label(text="(selected, in Edit Mode)", icon="BLANK1")


class SHEET_PT_liquid(bpy.types.Panel):
    """Of what the sheet is, or all of them."""
    bl_label, bl_parent_id = "Liquid", "SHEET_PT_part"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "physics"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return not context.object.sheet.file and role_of(context.object) == "SHEET"

    def draw(self, context: Any) -> None:
        layout, run, own = self.layout, context.scene.sheet_run, context.object.sheet_part.liquid
        layout.use_property_split, layout.use_property_decorate = True, False
        if own.own or len(things_with("SHEET", context.scene)) > 1:
            layout.prop(own, "own")
        liquid = own if own.own else run
        layout.prop(liquid, "liquid")
        for name, label, unit in (("viscosity", "Viscosity", "Pa s"), ("density", "Density", "kg/m³"),
                                  ("surface_tension", "Tension", "N/m")):
            row = layout.row()
            row.prop(liquid, name, text=label)
            row.label(text=unit)
        layout.prop(liquid, "look")
        layout.prop(run, "self_contact")


class SHEET_PT_run(bpy.types.Panel):
    """The run: begin, stop, go on, and how far it is."""
    bl_label, bl_parent_id = "Run", "SHEET_PT_part"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "physics"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return bool(context.object.sheet.file) or role_of(context.object) != "NONE"

    def draw(self, context: Any) -> None:
        layout, scene = self.layout, context.scene
        layout.use_property_split, layout.use_property_decorate = True, False
        for name in ("quality", "follow", "cache"):
            layout.prop(scene.sheet_run, name)
        for line in told_of_scene(scene):
            _message(layout, line, "ERROR")
        try:
            names = " and ".join(f'"{thing.name}"' for thing in sheets_of(scene))
            _, until = times_of(scene)
            folder = cache.folder_of(scene)
        except SheetError as error:
            _message(layout, str(error), "INFO")
            return
        layout.label(text=f"Frames {scene.frame_start} to {scene.frame_end}, {until:.3g} s of {names}")
        self.draw_buttons(layout, cache.progress_of(folder))
        if cache.is_older(folder, scene):
            _message(layout, "The run is older than the settings", "ERROR")

    def draw_buttons(self, layout: Any, state: cache.Progress) -> None:
        if state.alive:
            progress(layout, state.part, "" if state.left is None else f"{duration(state.left)} left")
            layout.label(text=state.message or "ends the run", icon="BLANK1")
            layout.operator("sheet.stop", icon="CANCEL")
            return
        row = layout.row(align=True)
        row.operator("sheet.check", text="Check", icon="VIEWZOOM")
        row.operator("sheet.simulate", icon="PLAY")
        if state.state == "none":
            return
        row = layout.row(align=True)
        row.operator("sheet.resume", icon="FF")
        row.operator("sheet.free", text="Free", icon="TRASH")
        _message(layout, words_of(state), "ERROR" if state.state == "failed" else "CHECKMARK")


class SHEET_OT_from_selection(bpy.types.Operator):
    """Make a vertex group of what is selected, which is held or where liquid enters"""
    bl_idname = "sheet.from_selection"
    bl_label = "From Selection"
    bl_options = {"REGISTER", "UNDO"}
    kind: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Kind", items=[(k, k.capitalize(), "") for k in ("pinned", "clamped", "inlet")], default="pinned")

    @classmethod
    def poll(cls, context: Any) -> bool:
        return context.object is not None and context.object.type == "MESH" and context.object.mode == "EDIT"

    def execute(self, context: Any) -> set[str]:
        thing = context.object
        made = bmesh.from_edit_mesh(thing.data)
        chosen = [v.index for v in made.verts if v.select]
        if self.kind == "inlet":
            chosen = sorted({v.index for e in made.edges if e.select and e.is_boundary for v in e.verts})
        if not chosen:
            self.report({"ERROR"}, "select edges of the sheet's border, where alone liquid can enter"
                        if self.kind == "inlet" else "select vertices that shall be held")
            return {"CANCELLED"}
        bpy.ops.object.mode_set(mode="OBJECT")
        name = getattr(thing.sheet_part, self.kind)
        group = thing.vertex_groups.get(name) or thing.vertex_groups.new(name=self.kind)
        group.remove(range(len(thing.data.vertices)))
        group.add(chosen, 1.0, "REPLACE")
        setattr(thing.sheet_part, self.kind, group.name)
        bpy.ops.object.mode_set(mode="EDIT")
        return {"FINISHED"}


CLASSES = (SHEET_PT_object, SHEET_PT_part, SHEET_PT_held, SHEET_PT_liquid, SHEET_PT_run, SHEET_OT_from_selection)
