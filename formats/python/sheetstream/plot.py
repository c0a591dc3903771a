# SPDX-License-Identifier: MIT
"""Figures of runs with matplotlib (the extra "plot").

>>> import matplotlib
>>> matplotlib.use("agg")
>>> from sheetstream import make_frame, plot
>>> frame = make_frame([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], 0.01)
>>> plot.sheet(frame).get_title()
't = 0 s'
"""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
from matplotlib import cm, colors
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .quantities import QUANTITIES, Quantity
from .run import Run
from .stream import Floats, Frame

# What only this package draws.
_OTHERS = {
    "speed_max": Quantity("frame", "m/s", "greatest speed", QUANTITIES["speed"].units),
    "triangles": Quantity("frame", "1", "triangles", (("1", 1.0),)),
    "vertices": Quantity("frame", "1", "vertices", (("1", 1.0),)),
}


def _told(name: str, values: Floats) -> tuple[str, float]:
    """Caption with the unit that suits the values, and by what SI values are multiplied to be in it."""
    quantity = (QUANTITIES | _OTHERS).get(name, Quantity("", "", name, (("1", 1.0),)))
    largest = np.nanmax(np.abs(values), initial=0)
    unit, size = next((unit for unit in quantity.units if largest >= unit[1]), quantity.units[-1])
    return f"{quantity.caption} [{unit}]" if unit != "1" else quantity.caption, 1 / size


def triangle_values(frame: Frame, quantity: str) -> Floats:
    """Thickness [m] or speed [m/s] of each triangle, or an array of the frame with a number a triangle or vertex."""
    if quantity == "thickness":
        return frame.thickness()
    if quantity == "speed":
        return np.linalg.norm(frame.velocity()[frame["triangle"]].mean(axis=1), axis=1)
    if quantity not in frame or np.ndim(frame[quantity]) != 1 or frame.arrays[quantity].place not in ("vertex",
        "triangle"):
        raise ValueError(f'"{quantity}" is neither thickness nor speed nor an array of the frame with a number a'
                         f' vertex or '
                         f"triangle; it has {', '.join(frame.arrays)}")
    values = np.asarray(frame[quantity], float)
    return values if frame.arrays[quantity].place == "triangle" else values[frame["triangle"]].mean(axis=1)


def sheet(frame: Frame, quantity: str = "thickness", ax: Any = None, limits: tuple[float, float] | None = None,
          cmap: str = "viridis", up: str = "z") -> Any:
    """Draws the frame in space, coloured by a quantity, and returns the axes (made if none are given).

    limits: of the colours, in SI units; by default all but the lowest and the highest hundredth. up: the axis "x", "y"
    or "z" that is drawn upwards.
    """
    if ax is None:
        ax = plt.figure(figsize=(6, 5), layout="constrained").add_subplot(projection="3d")
    values = triangle_values(frame, quantity)
    caption, factor = _told(quantity, values)
    values = factor * values
    low, high = (factor * np.array(limits)) if limits else np.percentile(values, (1, 99))
    norm = colors.Normalize(low, high if high > low else low + max(abs(low) * 1e-3, 1e-12))
    order = np.roll(np.arange(3), 2 - "xyz".index(up))  # the axes of the drawing
    points = frame["position"][:, order]
    shade = _shade(points[frame["triangle"]])
    colour = plt.get_cmap(cmap)(norm(values))
    colour[:, :3] *= shade[:, None]
    ax.add_collection3d(Poly3DCollection(points[frame["triangle"]], facecolors=colour, linewidths=0.2,
                                         edgecolors=colour))
    low_corner, high_corner = points.min(axis=0), points.max(axis=0)
    middle, half = (low_corner + high_corner) / 2, max((high_corner - low_corner).max(), 1e-12) / 2
    for axis, name, centre in zip("xyz", (f"{'xyz'[i]} [m]" for i in order), middle):
        getattr(ax, f"set_{axis}lim")(centre - half, centre + half)
        getattr(ax, f"set_{axis}label")(name)
        getattr(ax, f"{axis}axis").set_major_locator(plt.MaxNLocator(4))
    ax.set_box_aspect((1, 1, 1))
    ax.set_title(f"t = {frame.time:.4g} s")
    ax.figure.colorbar(cm.ScalarMappable(norm, cmap), ax=ax, shrink=0.7, pad=0.16,
                       label=caption)
    return ax


def _shade(corners: npt.NDArray[Any]) -> Floats:
    """How bright each triangle (m, 3, 3) is in light from above and aside."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    light = np.array([0.4, -0.5, 0.77])
    return 0.6 + 0.4 * np.abs(normal @ light) / np.where(length > 0, length, 1)


def curves(run: Run, quantities: Sequence[str] = ("volume", "thickness_min", "kinetic_energy"),
           axes: Any = None) -> Any:
    """Draws curves over time below each other, named as in sheetstream.run.CURVES, and returns the axes."""
    if axes is None:
        axes = plt.subplots(len(quantities), sharex=True, squeeze=False, figsize=(6, 1 + 1.6 * len(quantities)),
                            layout="constrained")[1][:, 0]
    data = run.curves()
    for ax, quantity in zip(axes, quantities):
        if quantity not in data or quantity in ("time", "step"):
            there = ", ".join(name for name in data if name not in ("time", "step"))
            raise ValueError(f'"{quantity}" is no curve; there are {there}')
        caption, factor = _told(quantity, data[quantity])
        ax.plot(data["time"], factor * data[quantity])
        ax.set_ylabel(caption.replace(" [", "\n["))
        ax.grid(alpha=0.3)
    axes[-1].set_xlabel("time [s]")
    return axes
