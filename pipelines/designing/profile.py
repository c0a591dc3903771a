# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of a scene's thickness, and what has become of the liquid that started there."""
import dataclasses

import numpy
from sheetstream import Array

from sweeping.problem import BAD_INPUT, Problem

START = "design.start"  # array: where each vertex started [m]; the stages carry it
_AXES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}


@dataclasses.dataclass
class Profile:
    over: str  # "radial", "x", "y" or "z"
    places: numpy.ndarray  # [m], increasing
    thickness: numpy.ndarray  # [m]

    @staticmethod
    def of(scene, path):
        """The scene's (of a frame, in SI units)."""
        sheets = scene["sheet"] if isinstance(scene["sheet"], list) else [scene["sheet"]]
        thickness = sheets[0]["thickness"]
        if len(sheets) > 1 or not isinstance(thickness, dict) or not thickness.keys() & {"radial", "along"}:
            raise Problem(BAD_INPUT, f"{path}: the scene takes one [sheet] whose thickness has the rows to begin with,"
                          " such as thickness = {radial = [[0, \"1.5 mm\"], [\"10 mm\", \"1.5 mm\"],"
                          " [\"20 mm\", \"1.5 mm\"]]}")  # fmt: skip
        rows = numpy.array(thickness["radial"] if "radial" in thickness else thickness["rows"], float)
        return Profile(thickness.get("along", "radial"), rows[:, 0], rows[:, 1])

    def toml(self):
        rows = ", ".join(f"[{s:.9g}, {h:.9g}]" for s, h in zip(self.places, self.thickness))
        if self.over == "radial":
            return f"{{radial = [{rows}]}}"
        return f"{{along = \"{self.over}\", rows = [{rows}]}}"

    def place_of(self, scene, positions):
        """Places [m] of positions of the sheet as it starts."""
        sheet = scene["sheet"][0] if isinstance(scene["sheet"], list) else scene["sheet"]
        x = positions - numpy.array(sheet.get("center", [0, 0, 0]), float)
        turn = sheet.get("rotation")
        if turn:  # back, by the formula of Rodrigues
            axis = numpy.array(turn["axis"], float)
            axis /= numpy.linalg.norm(axis)
            cosine, sine = numpy.cos(turn["angle"]), -numpy.sin(turn["angle"])
            x = cosine * x + sine * numpy.cross(axis, x) + (1 - cosine) * numpy.outer(x @ axis, axis)
        if self.over == "radial":
            return numpy.linalg.norm(x[:, _AXES[sheet["plane"]]], axis=1)
        return x[:, "xyz".index(self.over)]

    def shares(self, places):
        """How much of each row (columns) is in a place (rows): the hat functions between which it is linear."""
        return numpy.stack([numpy.interp(places, self.places, row) for row in numpy.eye(len(self.places))], axis=1)


def mark(frame):
    """Lets vertices remember where they start."""
    frame.arrays[START] = Array(frame["position"].copy(), "vertex", "m", "interpolate")


@dataclasses.dataclass
class Outcome:
    """Of a run whose first frame was marked, at its end."""

    places: numpy.ndarray  # of each triangle's middle, as it started [m]
    thickness: numpy.ndarray  # of each triangle [m]
    area: numpy.ndarray  # [m^2]
    rows: numpy.ndarray  # thickness around each row of the profile: volume over area there [m]

    @staticmethod
    def of(frame, profile):
        places = profile.place_of(frame.scene(), frame[START][frame["triangle"]].mean(axis=1))
        shares, area = profile.shares(places), frame.area()
        around = shares.T @ area
        if (around <= 0).any():
            missing = profile.places[numpy.argmax(around <= 0)]
            raise Problem(BAD_INPUT, f"no part of the sheet starts around the row at {missing:g} m: take it out, or"
                          " shorter edges")  # fmt: skip
        return Outcome(places, frame.thickness(), area, (shares.T @ frame["volume"]) / around)

    def percentiles(self, *percents):
        """Of the thickness, by area [m]."""
        order = numpy.argsort(self.thickness, kind="stable")
        passed = numpy.cumsum(self.area[order])
        return [self.thickness[order[numpy.searchsorted(passed, percent / 100 * passed[-1])]] for percent in percents]
