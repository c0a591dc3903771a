# SPDX-License-Identifier: GPL-3.0-or-later
"""Liquids to choose from: what they are made of and how they look. docs/blender.md has the sources."""
from __future__ import annotations

from typing import NamedTuple


class Liquid(NamedTuple):
    """viscosity [Pa s], density [kg/m³], surface_tension of each side [N/m]; look: a preset of sheet-render."""
    viscosity: float
    density: float
    surface_tension: float
    look: str
    note: str


PRESETS = {
    # tempered milk chocolate above its yield stress, plateau viscosity [Bergemann et al. 2018]; no tension: not known
    "chocolate": Liquid(8.7, 1300.0, 0.0, "chocolate", "milk chocolate, molten and tempered"),
    # those of sheet-init --example
    "caramel": Liquid(80.0, 1300.0, 0.0, "caramel", "as in the example scene"),
    # clover honey with 16 % of water at 20 °C: 190 poise, 1.42 g/cm³; 50 to 60 mN/m
    "honey": Liquid(19.0, 1420.0, 0.055, "honey", "clover honey at 20 °C"),
    # those of pipelines/pancake
    "batter": Liquid(1.5, 1050.0, 0.05, "batter", "of a pancake"),
    # soda-lime glass for containers: 10^4 poise is where it is worked, near 1000 °C; 315 mN/m at 1300 °C; 2.52 g/cm³
    "glass": Liquid(1000.0, 2520.0, 0.315, "glass", "soda-lime glass as it is worked"),
    # those of pipelines/film-casting
    "film": Liquid(5000.0, 900.0, 0.0, "film", "a polymer melt, drawn to film"),
}
OWN = "own"
