# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of results, results.csv: a line a run, with its parameters, exit code, steps, measures, time and memory.

Units stand in the header, `NAME [UNIT]`. Parameters are in their column's unit; what a row states in a unit of its own
is in SI units, as the run's scene has it. What is not known (a run that is not done) is empty.
"""
import csv
import os
import tomllib

from .plan import BLOCK, read_json, read_rows, run_folder
from .status import states
from .table import number

_ACCOUNT = {"seconds [s]": "seconds", "memory [B]": "memory", "attempts": "attempts", "host": "host"}


def write_results(folder, sweep):
    """Two passes, so that memory is needed for one run at a time: which measures there are, then the lines."""
    found = states(folder, sweep.count)
    measures = {}
    for index in (i for i, what in enumerate(found) if what == "done"):
        measures.update(dict.fromkeys(_outcome(folder, index)["measures"]))
        if index > BLOCK:
            break  # all runs are measured alike
    parameters = [f"{c.key} [{c.unit}]" if c.unit else c.key for c in sweep.columns]
    temporary = folder / f".results.{os.getpid()}"
    with open(temporary, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["run", *parameters, "state", "exit_code", "steps", *measures, *_ACCOUNT, "reason"])
        for block in range((sweep.count + BLOCK - 1) // BLOCK):
            for i, row in enumerate(read_rows(folder, block)):
                index = block * BLOCK + i
                out.writerow([index, *_parameters(folder, sweep, index, row), found[index],
                              *_line(folder, index, measures)])
    os.replace(temporary, folder / "results.csv")
    return folder / "results.csv"


def _outcome(folder, index):
    path = run_folder(folder, index)
    return read_json(path / "result.json") or read_json(path / "failed.json") or {}


def _line(folder, index, measures):
    outcome = _outcome(folder, index)
    account = read_json(run_folder(folder, index) / "account.json") or {}
    values = outcome.get("measures", {})
    return [outcome.get("exit_code", ""), outcome.get("steps", ""), *(values.get(name, "") for name in measures),
            *(account.get(key, "") for key in _ACCOUNT.values()), outcome.get("reason", "")]  # fmt: skip


def _parameters(folder, sweep, index, row):
    """The row's values; those that are no plain numbers as the run's scene states them."""
    if all(number(value) is not None for value in row):
        return row
    try:
        with open(run_folder(folder, index) / "scene.toml", "rb") as file:
            scene = tomllib.load(file)
    except (OSError, tomllib.TOMLDecodeError):
        return row
    return [value if number(value) is not None else _stated(scene, column.key, value) for column,
            value in zip(sweep.columns, row)]


def _stated(scene, key, otherwise):
    if "." not in key:
        return otherwise
    for part in key.split("."):
        try:
            scene = scene[int(part) if isinstance(scene, list) else part]
        except (KeyError, IndexError, ValueError, TypeError):
            return otherwise
    return otherwise if isinstance(scene, dict) else scene
