# SPDX-License-Identifier: GPL-3.0-or-later
"""What a DESIGN.toml asks: scene and ring, and the thickness that shall come out."""
import dataclasses
import pathlib
import re
import tomllib

import numpy

from fitting.question import in_si
from sweeping.problem import BAD_INPUT, IO, Problem

_LENGTH = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*")
_KEYS = ("scene", "ring", "until", "fps", "steps", "stop_when", "set", "target", "within", "runs")


@dataclasses.dataclass
class Question:
    scene: pathlib.Path
    ring: str
    loop: list  # options of sheet-loop
    sets: list  # KEY=VALUE for sheet-init
    target: numpy.ndarray  # rows of a place of the sheet at the start and the thickness that shall come out there [m]
    within: float  # relative
    runs: int  # at most

    def target_at(self, places):
        return numpy.interp(places, self.target[:, 0], self.target[:, 1])


def read(path):
    """Throws Problem with all that is wrong."""
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise Problem(IO, f"{path}: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise Problem(BAD_INPUT, f"{path}: {error}") from error
    wrong = [f"{path}: unknown key \"{key}\"; known: {', '.join(_KEYS)}" for key in table if key not in _KEYS]
    for key, example in (("scene", '"scene.toml"'), ("ring", '"sheet-step"'), ("target", '"1 mm"')):
        if not table.get(key):
            wrong.append(f"{path}: missing key \"{key}\", such as {key} = {example}")
    if "until" not in table and "steps" not in table:
        wrong.append(f"{path}: until when? until = 2, in seconds, or steps = 100")
    scene = path.parent / str(table.get("scene", ""))
    if table.get("scene") and not scene.is_file():
        wrong.append(f"{path}: scene: there is no \"{scene}\"")
    target = _read_target(table.get("target", "1 mm"))
    if target is None:
        wrong.append(f"{path}: target: expected a length such as \"1 mm\", or rows of a place at the start, increasing,"
                     " and the thickness there, such as [[0, \"1 mm\"], [\"20 mm\", \"2 mm\"]]")  # fmt: skip
    within, runs = table.get("within", 0.02), table.get("runs", 12)
    if not (isinstance(within, (int, float)) and 0 < within < 1):
        wrong.append(f"{path}: within: expected a part of the thickness, such as 0.02")
    if not (isinstance(runs, int) and runs > 0):
        wrong.append(f"{path}: runs: expected how many at most, such as 12")
    if wrong:
        raise Problem(BAD_INPUT, "\n".join(wrong))
    options = {"until": "--until", "fps": "--fps", "steps": "--steps", "stop_when": "--stop-when"}
    loop = [part for name, option in options.items() if name in table for part in (option, str(table[name]))]
    return Question(scene, table["ring"], loop, [str(s) for s in table.get("set", [])], target, within, runs)


def _metres(value):
    """None where it is no length."""
    match = _LENGTH.fullmatch(str(value))
    factor = in_si("length", match[2], "m") if match else None
    return None if factor is None else float(match[1]) * factor


def _read_target(value):
    rows = value if isinstance(value, list) else [[0, value]]
    if not rows or not all(isinstance(row, list) and len(row) == 2 for row in rows):
        return None
    numbers = [[_metres(cell) for cell in row] for row in rows]
    if any(cell is None for row in numbers for cell in row):
        return None
    target = numpy.array(numbers)
    return target if (numpy.diff(target[:, 0]) > 0).all() and (target[:, 1] > 0).all() else None
