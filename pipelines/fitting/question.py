# SPDX-License-Identifier: GPL-3.0-or-later
"""What a FIT.toml asks: scene and ring, the parameters that are sought, and what was measured."""
import csv
import dataclasses
import pathlib
import re
import tomllib

import numpy
from sheetstream.fit import Parameter

from sweeping.problem import BAD_INPUT, IO, Problem
from sweeping.run import unit_of
from sweeping.table import separators_are_wrong

_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*")
_HEADER = re.compile(r"\s*(.*?)\s*(?:\[\s*(.*?)\s*\])?\s*")
_PARTS = {"k": 1e3, "": 1.0, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9}  # of a unit, by what stands before it
_KEYS = ("scene", "ring", "until", "fps", "steps", "set", "difference", "parameter", "measured")


@dataclasses.dataclass
class Measured:
    """One curve, in SI units: values of an observer (a column of sheet-info --csv) at times [s]."""

    place: str  # for messages
    observer: str
    times: numpy.ndarray
    values: numpy.ndarray
    sigmas: numpy.ndarray  # standard deviations


@dataclasses.dataclass
class Question:
    scene: pathlib.Path
    ring: str
    loop: list  # options of sheet-loop
    sets: list  # KEY=VALUE for sheet-init
    difference: float  # of the ranges, by which slopes are found
    parameters: list  # of sheetstream.fit.Parameter, in the units below
    units: dict  # of the parameters by key; "": SI
    measured: list  # of Measured


def read(path):
    """Throws Problem with all that is wrong."""
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise Problem(IO, f"{path}: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise Problem(BAD_INPUT, f"{path}: {error}") from error
    wrong = [f"{path}: unknown key \"{key}\"; known: {', '.join(_KEYS)}" for key in table if key not in _KEYS]
    for key, example in (("scene", "\"scene.toml\""), ("ring", "\"sheet-step\""),
                         ("parameter", "[[parameter]] key = \"material.viscosity\""),
                         ("measured", "[[measured]] file = \"sag.csv\"")):
        if not table.get(key):
            wrong.append(f"{path}: missing key \"{key}\", such as {example}")
    if "until" not in table and "steps" not in table:
        wrong.append(f"{path}: until when? until = \"1 s\", with fps = 25 or so, or steps = 100")
    if wrong:
        raise Problem(BAD_INPUT, "\n".join(wrong))
    scene = path.parent / str(table["scene"])
    if not scene.is_file():
        wrong.append(f"{path}: scene: there is no \"{scene}\"")
    parameters, units = _read_parameters(path, table["parameter"], wrong)
    measured = [_read_measured(path, i, entry, wrong) for i, entry in enumerate(table["measured"])]
    if wrong:
        raise Problem(BAD_INPUT, "\n".join(wrong))
    loop = [part for name in ("until", "fps", "steps") if name in table for part in (f"--{name}", str(table[name]))]
    return Question(scene, table["ring"], loop, [str(s) for s in table.get("set", [])],
                    float(table.get("difference", 0.01)), parameters, units, measured)


def _read_parameters(path, entries, wrong):
    parameters, units = [], {}
    for i, entry in enumerate(entries):
        place = f"{path}: parameter {i + 1}"
        unknown = set(entry) - {"key", "from", "to", "start", "log"}
        missing = {"key", "from", "to"} - set(entry)
        if unknown or missing:
            wrong += [f"{place}: unknown key \"{key}\"; known: key, from, to, start, log" for key in sorted(unknown)]
            wrong += [f"{place}: missing key \"{key}\"" for key in sorted(missing)]
            continue
        ends = {name: _QUANTITY.fullmatch(str(entry[name])) for name in ("from", "to", "start") if name in entry}
        if not all(ends.values()) or len({end[2] for end in ends.values()}) != 1:
            wrong.append(f"{place}: from, to and start are numbers of one unit, such as \"50 Pa*s\"")
            continue
        numbers = {name: float(end[1]) for name, end in ends.items()}
        if entry["key"] in units:
            wrong.append(f"{place}: {entry['key']} stands there twice")
        try:
            parameters.append(Parameter(entry["key"], numbers["from"], numbers["to"], bool(entry.get("log", False)),
                                        numbers.get("start")))
        except ValueError as error:
            wrong.append(f"{place}: {error}")
        units[entry["key"]] = ends["from"][2]
    return parameters, units


def in_si(text, unit, si):
    """How many `si` a `unit` is; None where it is none."""
    if unit in ("", si) or (unit == "1" and not si):
        return 1.0
    for before, part in _PARTS.items():
        if unit == before + si:
            return part
    return None


def _read_measured(path, i, entry, wrong):
    place = f"{path}: measured {i + 1}"
    unknown, missing = set(entry) - {"file", "observer", "sigma"}, {"file", "observer"} - set(entry)
    if unknown or missing:
        wrong += [f"{place}: unknown key \"{key}\"; known: file, observer, sigma" for key in sorted(unknown)]
        wrong += [f"{place}: missing key \"{key}\"" for key in sorted(missing)]
        return None
    file, observer = path.parent / entry["file"], entry["observer"]
    columns = {"time": ("s", []), observer: (unit_of(observer), []), "sigma": (unit_of(observer), [])}
    try:
        with open(file, newline="", encoding="utf-8-sig") as text:
            rows = [(number, row) for number, row in enumerate(csv.reader(text), 1)
                    if row and not row[0].lstrip().startswith("#")]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        wrong.append(f"{place}: {file}: {getattr(error, 'strerror', None) or error}")
        return None
    before = len(wrong)
    if rows and (problem := separators_are_wrong(",".join(rows[0][1]))):
        wrong.append(f"{file}:{rows[0][0]}: {problem}")
        return None
    header = [_HEADER.fullmatch(cell) for cell in rows[0][1]] if rows else []
    names, factors = [cell[1] for cell in header], []
    for cell in header:
        si = columns.get(cell[1], ("", []))[0]
        factors.append(in_si(cell[0], cell[2] or "", si))
        if cell[1] not in columns:
            wrong.append(f"{file}:{rows[0][0]}: unknown column \"{cell[1]}\"; known: {', '.join(columns)}")
        elif factors[-1] is None:
            wrong.append(f"{file}:{rows[0][0]}: column \"{cell[1]}\": [{cell[2]}] is not [{si}], nor a part of it")
    for name in ("time", observer):
        if name not in names:
            wrong.append(f"{file}:1: column \"{name}\" is missing; the first line names the columns, such as time [s],"
                         f" {observer} [{unit_of(observer) or 1}]")
    for number, row in rows[1:] if len(wrong) == before else []:
        try:
            if len(row) != len(names):
                raise ValueError
            for name, factor, cell in zip(names, factors, row):
                columns[name][1].append(factor * float(cell))
        except ValueError:
            wrong.append(f"{file}:{number}: expected {len(names)} numbers")
    values = {name: numpy.array(numbers) for name, (_, numbers) in columns.items()}
    if len(wrong) == before and values["time"].size == 0:
        wrong.append(f"{file}: no rows")
    if len(wrong) == before and "sigma" not in names:
        sigma = _QUANTITY.fullmatch(str(entry.get("sigma", "")))
        factor = in_si("sigma", sigma[2], columns[observer][0]) if sigma else None
        if factor is None or not float(sigma[1]) > 0:
            wrong.append(f"{place}: sigma, the standard deviation of what was measured, such as sigma = "
                         f"\"0.1 {columns[observer][0] or ''}\", or a column of the file")
        else:
            values["sigma"] = numpy.full(values["time"].shape, factor * float(sigma[1]))
    if len(wrong) == before and not (values["sigma"] > 0).all():
        wrong.append(f"{file}: every sigma is positive")
    if len(wrong) > before:
        return None
    return Measured(place, observer, values["time"], values[observer], values["sigma"])


def judged(result):
    """What chi^2 says of scene and measurements."""
    spread = (2 * result.freedom) ** 0.5  # of chi^2 [Pearson 1900]
    if result.chi2 > result.freedom + 3 * spread:
        return "scene and measurements do not agree within sigma; errors are too small then"
    if result.chi2 < result.freedom - 3 * spread:
        return "they agree better than sigma says"
    return "they agree within sigma"
