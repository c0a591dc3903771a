# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials as sheet-render's presets, and false colours of the thickness."""
from __future__ import annotations

import math
from typing import Any

import bpy

from .compat import nodes_of, sheetstream, socket_of
from .errors import SheetError
from .programs import LIQUIDS

OPAQUE = 1000  # scattering [1/m] from which a few millimetres hide what is behind
THICKNESS_LOOK = "thickness"
TOLD_APART = ("caramel", "chocolate", "batter", "honey", "glass", "film")  # the first few are easy to tell apart


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
    tree = nodes_of(material)
    nodes, link = tree.nodes, tree.links.new
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    if kind == THICKNESS_LOOK:
        link(_false_colours(tree), output.inputs["Surface"])
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
        link(_volume(tree, absorption, scattering), output.inputs["Volume"])
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
    tree.links.new(socket_of(attribute.outputs, "Fac"), scale.inputs["Value"])
    tree.links.new(scale.outputs["Result"], socket_of(ramp.inputs, "Fac"))
    tree.links.new(ramp.outputs["Color"], matte.inputs["Color"])
    return matte.outputs["BSDF"]


def set_materials(thing: bpy.types.Object, names: str, scene: bpy.types.Scene, liquids: int = 1) -> None:
    """Gives the object materials of presets, of which `names` has one or, with commas, those of so many liquids in
    turn, and Cycles enough bounces to see through them. Where the last name is "...", further liquids are told apart by
    others."""
    kinds = [name.strip() for name in names.split(",")]
    if kinds[-1] == "...":
        kinds.pop()
        further = [] if THICKNESS_LOOK in kinds else [kind for kind in TOLD_APART if kind not in kinds]
        kinds += further[:max(0, liquids - len(kinds))]
    for kind in kinds:
        if kind not in (*LIQUIDS, THICKNESS_LOOK):
            raise SheetError(f'material "{kind}" is unknown: choose {", ".join((*LIQUIDS, THICKNESS_LOOK))}')
    thing.data.materials.clear()
    for kind in kinds:
        thing.data.materials.append(make_material(kind))
    if any(kind in LIQUIDS and min(LIQUIDS[kind][2]) < OPAQUE for kind in kinds) and hasattr(scene, "cycles"):
        scene.cycles.volume_bounces = max(scene.cycles.volume_bounces, 4)
        scene.cycles.transmission_bounces = max(scene.cycles.transmission_bounces, 12)
