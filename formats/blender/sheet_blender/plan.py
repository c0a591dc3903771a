# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene is made of, before it is written: sheets, liquids, solids."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import bpy

from .holds import kind_of


class Material(NamedTuple):
    """What a liquid is: viscosity [Pa s], density [kg/m³], tension of each of its surfaces [N/m]."""
    viscosity: float = 80.0
    density: float = 1300.0
    surface_tension: float = 0.0


@dataclass
class SheetPlan:
    """One sheet. Lengths in metres, but for `edges` [Blender's units]; 0: as the mesh has them."""
    thing: bpy.types.Object
    thickness: float = 0.005
    edges: float = 0.0
    material: Material | None = None  # its own; None: the scene's
    holds: dict[str, str] = field(default_factory=dict)  # {vertex group: kind}
    inlet: str = ""  # vertex group
    inlet_speed: float = 0.1  # [m/s]

    @property
    def groups(self) -> list[str]:
        """The vertex groups that it needs."""
        return [*self.holds, *([self.inlet] if self.inlet else [])]


@dataclass
class Plan:
    """A scene: at least one sheet; solids with their contact."""
    sheets: list[SheetPlan]
    material: Material = Material()
    self_contact: bool = True
    solids: list[tuple[bpy.types.Object, str]] = field(default_factory=list)


class Written(NamedTuple):
    """files: what was written; told: what the scene has not of what Blender shows, in words for the user."""
    files: list[str]
    told: list[str]


def holds_by_name(thing: bpy.types.Object) -> dict[str, str]:
    return {group.name: kind for group in thing.vertex_groups if (kind := kind_of(group.name))}


def plain(value: float) -> float:
    """A number that Blender has in single precision, as a user would write it."""
    return float(f"{value:.7g}")
