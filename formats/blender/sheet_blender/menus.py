# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Import and File > Export."""
from __future__ import annotations

from typing import Any

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from .errors import SheetError
from .follow import import_bodies, import_run
from .looks import THICKNESS_LOOK
from .plan import Material, Plan, SheetPlan, holds_by_name, plain
from .programs import LIQUIDS, key_property
from .scene_file import write_scene


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
    further: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Further", description="Materials of the scene's second liquid, its third, ..., with commas; empty: others"
                                    " that tell them apart")
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
            material = f"{self.material},{self.further or '...'}"
            thing = import_run(self.filepath, material, self.up, self.start, self.speed, self.between, self.slab,
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
    """Export the active object as a scene of Sheet: vertex groups "pinned..." and "clamped..." are holds"""
    bl_idname = "sheet.export_scene"
    bl_label = "Export Sheet scene"
    filename_ext = ".toml"
    filter_glob: bpy.props.StringProperty(default="*.toml", options={"HIDDEN"})  # type: ignore[valid-type]
    thickness: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Thickness", description='Where the mesh has no attribute "thickness"', default=0.005, min=1e-9,
        unit="LENGTH")
    viscosity: key_property("material.viscosity", default=80.0)  # type: ignore[valid-type]
    density: key_property("material.density", default=1300.0)  # type: ignore[valid-type]
    solids: bpy.props.BoolProperty(name="Other selected objects are solids", default=True)  # type: ignore[valid-type]
    self_contact: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Self contact", description="The sheet does not pass through itself", default=True)

    def execute(self, context: Any) -> set[str]:
        active = context.view_layer.objects.active
        others = [(o, o.sheet_part.contact) for o in context.selected_objects if o is not active] if self.solids else []
        try:
            if active is None:
                raise SheetError("choose a mesh: there is no active object")
            length = context.scene.unit_settings.scale_length
            plan = Plan([SheetPlan(active, plain(self.thickness * length), holds=holds_by_name(active))],
                        Material(plain(self.viscosity), plain(self.density)), self.self_contact, others)
            written = write_scene(self.filepath, plan)
        except (SheetError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for line in written.told:
            self.report({"WARNING"}, line)
        self.report({"INFO"}, "Written: " + ", ".join(written.files))
        return {"FINISHED"}


def _import_entry(self: Any, _context: Any) -> None:
    self.layout.operator(SHEET_OT_import.bl_idname, text="Sheet run (.sheet)")
    self.layout.operator(SHEET_OT_import_bodies.bl_idname, text="Sheet bodies (.ply)")


def _export_entry(self: Any, _context: Any) -> None:
    self.layout.operator(SHEET_OT_export.bl_idname, text="Sheet scene (.toml)")


CLASSES = (SHEET_OT_import, SHEET_OT_import_bodies, SHEET_OT_export)


def register() -> None:
    bpy.types.TOPBAR_MT_file_import.append(_import_entry)
    bpy.types.TOPBAR_MT_file_export.append(_export_entry)


def unregister() -> None:
    bpy.types.TOPBAR_MT_file_export.remove(_export_entry)
    bpy.types.TOPBAR_MT_file_import.remove(_import_entry)
