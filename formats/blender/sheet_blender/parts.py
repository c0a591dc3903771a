# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user says of objects, collections and the scene: which are sheets, which solids, of what and how."""
from __future__ import annotations

from typing import Any

import bpy

from .errors import SheetError
from .evaluated import WITH_SURFACE
from .liquids import OWN, PRESETS
from .looks import THICKNESS_LOOK
from .programs import LIQUIDS, SCENE_KEYS, key_property
from .plan import Material, Plan, SheetPlan, holds_by_name, plain

ROLES = (("AUTO", "As Its Collection", "What the collection is that the object is in"),
         ("SHEET", "Sheet", "A sheet of liquid; there may be several"),
         ("SOLID", "Solid", "What the liquid meets; it may be animated"),
         ("NONE", "None", "Not in the simulation"))
QUALITIES = (("draft", "Draft", "Edges of twice the length and larger steps: a first look"),
             ("normal", "Normal", "As the mesh is"),
             ("fine", "Fine", "Edges of half the length and smaller steps"))


def _contact_items() -> list[tuple[str, str, str]]:
    words = SCENE_KEYS["solid.N.contact"][0].split("|")
    what = {"stick": "Liquid stays where it touches", "flow": "It flows in a layer that the solid drags",
            "slip": "It slides without drag"}
    return [(word, word.capitalize(), what[word]) for word in words]


def _take_preset(self: Any, _context: Any) -> None:
    if self.liquid in PRESETS:
        preset = PRESETS[self.liquid]
        self.viscosity, self.density, self.surface_tension = preset.viscosity, preset.density, preset.surface_tension
        self.look = preset.look


class _Liquid:
    """What a liquid is and how it looks."""
    liquid: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Liquid", description="Sets viscosity, density, surface tension and look", update=_take_preset,
        items=[*((name, name.capitalize(), preset.note) for name, preset in PRESETS.items()),
               (OWN, "Own", "As it is set below")], default="caramel")
    viscosity: key_property("material.viscosity", default=PRESETS["caramel"].viscosity)  # type: ignore[valid-type]
    density: key_property("material.density", default=PRESETS["caramel"].density)  # type: ignore[valid-type]
    surface_tension: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Surface tension [N/m]", description=SCENE_KEYS["material.surface_tension"][2], min=0.0, precision=4)
    look: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Look", description="Of the result, if the mesh has no materials of its own", default="caramel",
        items=[(name, name.capitalize(), "") for name in (*LIQUIDS, THICKNESS_LOOK)])


class SheetLiquid(_Liquid, bpy.types.PropertyGroup):
    """Of an object, if that has its own."""
    own: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Another Liquid", description="This sheet is of another liquid than the others", default=False)


class SheetPart(bpy.types.PropertyGroup):
    """Of an object."""
    role: bpy.props.EnumProperty(name="Role", items=ROLES, default="AUTO")  # type: ignore[valid-type]
    thickness: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Thickness", description='Of the liquid, where the mesh has no attribute "thickness"', default=0.005,
        min=1e-9, unit="LENGTH", precision=4)
    edges: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Edges", description="Longer edges are split before the run; 0: the mesh is taken as it is", default=0.0,
        min=0.0, unit="LENGTH", precision=4)
    pinned: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Pinned", description='Vertex group that is held in place; those named "pinned..." are, too')
    clamped: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Clamped", description='Vertex group held in place and slope; those named "clamped..." are, too')
    inlet: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Inlet", description="Vertex group of the part of the border where liquid enters")
    inlet_speed: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Speed", description="With which liquid enters, along the sheet", default=0.1, min=1e-6, unit="VELOCITY")
    contact: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Contact", description=SCENE_KEYS["solid.N.contact"][2].capitalize(), items=_contact_items(),
        default="stick")
    liquid: bpy.props.PointerProperty(type=SheetLiquid)  # type: ignore[valid-type]
    result: bpy.props.PointerProperty(type=bpy.types.Object)  # type: ignore[valid-type]


class SheetCollection(bpy.types.PropertyGroup):
    """Of a collection."""
    role: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Role", description="Of its objects that have none of their own", items=ROLES[1:], default="NONE")


class SheetRun(_Liquid, bpy.types.PropertyGroup):
    """Of the scene: of what liquid, and how it is run."""
    self_contact: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Self Contact", description="The sheet does not pass through itself", default=True)
    quality: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Quality", items=QUALITIES, default="normal")
    follow: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Show Newest Frame", description="The scene goes to the newest frame of the run", default=True)
    cache: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Cache", subtype="DIR_PATH", description="Folder of the run; empty: beside the .blend")


def role_of(thing: bpy.types.Object) -> str:
    """SHEET, SOLID or NONE: the object's, or that of the first of its collections that has one."""
    if thing.sheet_part.role != "AUTO":
        return str(thing.sheet_part.role)
    return next((c.sheet_collection.role for c in thing.users_collection if c.sheet_collection.role != "NONE"), "NONE")


def things_with(role: str, scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Objects of this role in the order of their names; what follows a run is none."""
    return sorted((thing for thing in scene.objects
                   if thing.type in WITH_SURFACE and role_of(thing) == role and not thing.sheet.file),
                  key=lambda thing: thing.name)


def sheets_of(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """The sheets of the scene, at least one. Raises SheetError."""
    found = things_with("SHEET", scene)
    if not found:
        raise SheetError("no object is a sheet: choose one, and Sheet > Role > Sheet in its physics properties")
    return found


def liquid_of(thing: bpy.types.Object, scene: bpy.types.Scene) -> Any:
    """The settings of a sheet's liquid: its own, or those of the scene."""
    return thing.sheet_part.liquid if thing.sheet_part.liquid.own else scene.sheet_run


def _material_of(liquid: Any) -> Material:
    return Material(plain(liquid.viscosity), plain(liquid.density), plain(liquid.surface_tension))


def _sheet_plan_of(thing: bpy.types.Object, scene: bpy.types.Scene) -> SheetPlan:
    part, length = thing.sheet_part, scene.unit_settings.scale_length
    holds = holds_by_name(thing) | {name: kind for name, kind in ((part.pinned, "pinned"), (part.clamped, "clamped"))
                                    if name}
    return SheetPlan(thing, plain(part.thickness * length), part.edges,
                     _material_of(part.liquid) if part.liquid.own else None, holds, part.inlet,
                     plain(part.inlet_speed * length))


def plan_of(scene: bpy.types.Scene) -> Plan:
    """What the panels say. Raises SheetError."""
    run = scene.sheet_run
    return Plan([_sheet_plan_of(thing, scene) for thing in sheets_of(scene)], _material_of(run), run.self_contact,
                [(solid, solid.sheet_part.contact) for solid in things_with("SOLID", scene)])


def times_of(scene: bpy.types.Scene) -> tuple[float, float]:
    """Frames a second, and the end of the run [s], which begins at the scene's first frame."""
    rate = scene.render.fps / scene.render.fps_base
    frames = scene.frame_end - scene.frame_start
    if frames < 1:
        raise SheetError("the scene has one frame: set its last one (Output > Frame Range > End)")
    return rate, frames / rate
