# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender shows of the objects of a plan that the run has not, in words for the user."""
from __future__ import annotations

from collections import Counter

import bpy

from .parts import role_of
from .plan import Plan


def told_of_things(plan: Plan) -> list[str]:
    """Of copies and modifiers, as they are at the scene's frame."""
    return _of_instances(plan) + _of_modifiers(plan)


def _of_instances(plan: Plan) -> list[str]:
    """Of copies that collections, vertices, faces, particles or geometry nodes show without objects of their own."""
    things = {sheet.thing.name for sheet in plan.sheets} | {solid.name for solid, _ in plan.solids}
    count: Counter[tuple[str, str]] = Counter()
    for shown in bpy.context.evaluated_depsgraph_get().object_instances:
        if shown.is_instance and shown.parent is not None:
            thing, parent = shown.instance_object.original, shown.parent.original
            if thing.name in things or parent.name in things or role_of(thing) != "NONE":
                count[thing.name, parent.name] += 1
    return [f'"{parent}" shows {"a copy" if n == 1 else f"{n} copies"} of "{thing}", which the run has not: Object >'
            " Apply > Make Instances Real makes objects of them (in geometry nodes Realize Instances)"
            for (thing, parent), n in count.items()]


def _of_modifiers(plan: Plan) -> list[str]:
    told = []
    sheets = [sheet.thing for sheet in plan.sheets]
    for thing in (*sheets, *(solid for solid, _ in plan.solids)):
        for modifier in thing.modifiers:
            where = f'modifier "{modifier.name}" of "{thing.name}"'
            if modifier.show_viewport != modifier.show_render:
                told.append(f"{where} is off in viewports: the run begins without it" if modifier.show_render else
                            f"{where} is off in renders: the run begins with it")
            elif (levels := _levels(modifier)) is not None and levels[0] != levels[1]:
                told.append(f"{where} has {levels[0]} in viewports and {levels[1]} in renders: the run begins with the"
                            " first")
            if modifier.type == "SOLIDIFY" and modifier.show_viewport and thing in sheets:
                told.append(f"{where} makes two sheets of one, joined at the rim: take it away, as a sheet has its"
                            " Thickness without it")
    return told


def _levels(modifier: bpy.types.Modifier) -> tuple[str, str] | None:
    """How finely a modifier subdivides in viewports and in renders, as the scene's Simplify lets it; None if it does
    not subdivide."""
    if modifier.type not in ("SUBSURF", "MULTIRES"):
        return None
    render = bpy.context.scene.render
    most = (render.simplify_subdivision, render.simplify_subdivision_render) if render.use_simplify else (100, 100)
    levels = (min(modifier.levels, most[0]), min(modifier.render_levels, most[1]))
    return tuple(f"{level} {'level' if level == 1 else 'levels'}" for level in levels)  # type: ignore[return-value]
