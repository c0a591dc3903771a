# SPDX-License-Identifier: MIT
"""What is measured and shown of a sheet. Made by formats/python/make_quantities from the tables of sheet-info."""
from __future__ import annotations

from typing import NamedTuple


class Quantity(NamedTuple):
    """Where it is: at each triangle, at each vertex, or one of the frame; its SI unit; units in which it is easy to
    read, with their sizes, from large to small; stops of its false colours: place from 0 to 1, red, green, blue."""

    where: str
    unit: str
    caption: str
    units: tuple[tuple[str, float], ...]
    stops: tuple[tuple[float, ...], ...] = ()


QUANTITIES = {
    "thickness": Quantity("triangle", "m", "thickness",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09)),
        ((0.0, 0.12, 0.05, 0.28), (0.17, 0.19, 0.19, 0.52), (0.34, 0.11, 0.37, 0.6), (0.5, 0.07, 0.53, 0.56), (0.67,
         0.24, 0.69, 0.42), (0.84, 0.65, 0.82, 0.22), (1.0, 0.99, 0.92, 0.33))),
    "curvature": Quantity("vertex", "1/m", "mean curvature",
        (("1/mm", 1000.0), ("1/m", 1.0), ("1/km", 0.001)),
        ((0.0, 0.09, 0.25, 0.55), (0.25, 0.45, 0.66, 0.84), (0.5, 0.95, 0.95, 0.94), (0.75, 0.9, 0.57, 0.42), (1.0,
         0.62, 0.1, 0.15))),
    "speed": Quantity("vertex", "m/s", "speed",
        (("m/s", 1.0), ("mm/s", 0.001), ("µm/s", 1e-06), ("nm/s", 1e-09)),
        ((0.0, 0.12, 0.05, 0.28), (0.17, 0.19, 0.19, 0.52), (0.34, 0.11, 0.37, 0.6), (0.5, 0.07, 0.53, 0.56), (0.67,
         0.24, 0.69, 0.42), (0.84, 0.65, 0.82, 0.22), (1.0, 0.99, 0.92, 0.33))),
    "contacts": Quantity("vertex", "1", "contacts",
        (("1", 1.0),)),
    "area": Quantity("frame", "m^2", "area",
        (("m²", 1.0), ("cm²", 0.0001), ("mm²", 1e-06))),
    "volume": Quantity("frame", "m^3", "volume",
        (("m³", 1.0), ("l", 0.001), ("ml", 1e-06))),
    "thickness_min": Quantity("frame", "m", "least thickness",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "thickness_mean": Quantity("frame", "m", "mean thickness",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "thickness_max": Quantity("frame", "m", "greatest thickness",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "kinetic_energy": Quantity("frame", "J", "kinetic energy",
        (("J", 1.0), ("mJ", 0.001), ("µJ", 1e-06))),
    "gravity_energy": Quantity("frame", "J", "energy of height",
        (("J", 1.0), ("mJ", 0.001), ("µJ", 1e-06))),
    "surface_energy": Quantity("frame", "J", "energy of surface",
        (("J", 1.0), ("mJ", 0.001), ("µJ", 1e-06))),
    "momentum_x": Quantity("frame", "kg m/s", "momentum",
        (("kg m/s", 1.0),)),
    "momentum_y": Quantity("frame", "kg m/s", "momentum",
        (("kg m/s", 1.0),)),
    "momentum_z": Quantity("frame", "kg m/s", "momentum",
        (("kg m/s", 1.0),)),
    "angular_momentum_x": Quantity("frame", "kg m^2/s", "angular momentum",
        (("kg m^2/s", 1.0),)),
    "angular_momentum_y": Quantity("frame", "kg m^2/s", "angular momentum",
        (("kg m^2/s", 1.0),)),
    "angular_momentum_z": Quantity("frame", "kg m^2/s", "angular momentum",
        (("kg m^2/s", 1.0),)),
    "x_min": Quantity("frame", "m", "bounding box",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "y_min": Quantity("frame", "m", "bounding box",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "z_min": Quantity("frame", "m", "bounding box",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "x_max": Quantity("frame", "m", "bounding box",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "y_max": Quantity("frame", "m", "bounding box",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "z_max": Quantity("frame", "m", "bounding box",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "edge_min": Quantity("frame", "m", "least edges",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "edge_mean": Quantity("frame", "m", "mean edges",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "edge_max": Quantity("frame", "m", "greatest edges",
        (("m", 1.0), ("mm", 0.001), ("µm", 1e-06), ("nm", 1e-09))),
    "angle_min_degrees": Quantity("frame", "degrees", "angles",
        (("degrees", 1.0),)),
    "angle_max_degrees": Quantity("frame", "degrees", "angles",
        (("degrees", 1.0),)),
    "aspect_max": Quantity("frame", "1", "worst aspect",
        (("1", 1.0),)),
}
