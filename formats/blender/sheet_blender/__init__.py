# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheet in Blender (3.4 and later): simulate sheets in it, import runs as meshes that change with time, export scenes.

Physics properties > Sheet, File > Import > Sheet run (.sheet) or Sheet bodies (.ply), File > Export > Sheet scene
(.toml); docs/blender.md is the page. It reads streams by the package sheetstream, which lies beside it in the zip file
that the build makes. In scripts:

    import sheet_blender
    thing = sheet_blender.import_run("run.sheet", material="honey")
    thing = sheet_blender.import_bodies("body_0000.ply", material="honey", up="Y")
    sheet_blender.export_scene("scene.toml", thing, thickness=0.005)
    bpy.ops.sheet.simulate()
"""
from __future__ import annotations

import bpy

from . import (body_files, cache, carried, checks, compat, evaluated, follow, holds, left_out, liquids, looks, menus,
               meshes, movement, panels, parts, plan, ply_file, programs, scene_file, seams, selection, sheet_tables,
               simulate, slab, solids)
from .compat import sheetstream
from .errors import SheetError
from .follow import import_bodies, import_run
from .movement import export_motion
from .programs import LIQUIDS
from .scene_file import export_scene

__all__ = ["LIQUIDS", "SheetError", "body_files", "carried", "compat", "evaluated", "export_motion", "export_scene",
           "holds", "import_bodies", "import_run", "liquids", "meshes", "sheetstream", "slab", "solids"]

bl_info = {
    "name": "Sheet: thin viscous sheets",
    "author": "the authors of Sheet",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Physics properties > Sheet, File > Import, File > Export",
    "description": "Simulates sheets of viscous liquid, imports runs as meshes that change with time, exports scenes",
    "category": "Physics",
}

CLASSES = (programs.SheetPreferences, follow.SheetSettings, parts.SheetLiquid, parts.SheetPart, parts.SheetCollection,
           parts.SheetRun,
           *menus.CLASSES, *simulate.CLASSES, *checks.CLASSES, *panels.CLASSES)


def register() -> None:
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.sheet = bpy.props.PointerProperty(type=follow.SheetSettings)
    bpy.types.Object.sheet_part = bpy.props.PointerProperty(type=parts.SheetPart)
    bpy.types.Collection.sheet_collection = bpy.props.PointerProperty(type=parts.SheetCollection)
    bpy.types.Scene.sheet_run = bpy.props.PointerProperty(type=parts.SheetRun)
    menus.register()
    bpy.app.handlers.frame_change_pre.append(follow.on_frame_change)
    bpy.app.handlers.load_post.append(simulate.on_load)


def unregister() -> None:
    bpy.app.handlers.load_post.remove(simulate.on_load)
    bpy.app.handlers.frame_change_pre.remove(follow.on_frame_change)
    menus.unregister()
    del bpy.types.Scene.sheet_run, bpy.types.Collection.sheet_collection, bpy.types.Object.sheet_part
    del bpy.types.Object.sheet
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
