# SPDX-License-Identifier: GPL-3.0-or-later
"""The plan of a sweep: what every run shall be, and its folder.

    sweep.json          what holds for all runs; `id` is the checksum of everything that decides results
    plan/012.csv        the rows of the runs 12,000 to 12,999
    inputs/             the scene, and the files that it names: all that a run needs besides the programs
    runs/012/345/       run 12,345: see run.py
    results.csv         see results.py
No folder has more than 1,000 entries of its kind, and no file grows with the number of runs but results.csv.
"""
import csv
import dataclasses
import hashlib
import itertools
import json
import os
import re
import shutil

from .problem import BAD_INPUT, IO, USAGE, Problem
from .table import Column, number

BLOCK = 1000
SCENE = "scene.toml"
_NAME = re.compile(r"\{([A-Za-z_]\w*)\}")


@dataclasses.dataclass
class Sweep:
    """What holds for all runs. Texts may have {NAME}, which stands for the row's value in that column."""

    columns: list  # of Column, with the units in which their plain numbers are
    named: list  # KEY=VALUE for sheet-init, of the files that the scene names; a row may name others
    sets: list  # KEY=VALUE for sheet-init, after those of a row
    loop: list  # options of sheet-loop
    ring: str
    measure: str  # a command that prints names and values, or ""
    command: str  # a command that is all of the run, instead of scene, ring and measures; or ""
    files: dict  # file as a row says it: its name in inputs/
    hashes: dict  # name in inputs/: SHA-256
    count: int
    id: str = ""

    def texts(self):
        return [*self.sets, *self.loop, self.ring, self.measure, self.command]


def names_in(text):
    """The NAMEs that stand in braces in the text."""
    return _NAME.findall(text)


def filled(text, sweep, row):
    """The text with every {NAME} replaced."""
    values = {column.key: value for column, value in zip(sweep.columns, row)}
    return _NAME.sub(lambda match: values.get(match[1], match[0]), text)


def settings(sweep, row):
    """What sheet-init is told for the row, KEY=VALUE each."""
    told = list(sweep.named)
    for column, value in zip(sweep.columns, row):
        if "." not in column.key:
            continue
        if column.is_file and value in sweep.files:
            value = sweep.files[value]
        elif column.unit and number(value) is not None:
            value = f"{value} {column.unit}"
        told.append(f"{column.key}={value}")
    return told + [filled(text, sweep, row) for text in sweep.sets]


def run_folder(folder, index):
    return folder / "runs" / f"{index // BLOCK:03d}" / f"{index % BLOCK:03d}"


def copy_inputs(scene, named, given, inputs):
    """Copies the scene, the files that it names ({key: path}) and those that rows do (texts, seen from the scene).
    (named, files, hashes) of Sweep."""
    hashes = {SCENE: copy_input(scene, inputs, SCENE)[1]}

    def copied(path):
        name, digest = copy_input(path, inputs)
        hashes[name] = digest
        return name

    settled = [f"{key}={copied(path)}" for key, path in named.items()]
    return settled, {text: copied(scene.parent / text) for text in given}, hashes


def copy_input(source, inputs, name=""):
    """Copies a file, under a name that begins with its checksum if none is given. (name, SHA-256)."""
    try:
        with open(source, "rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
        name = name or f"{digest[:8]}-{source.name}"
        shutil.copyfile(source, inputs / name)
    except OSError as error:
        raise Problem(BAD_INPUT, f"{source}: {error.strerror} (a file that every run needs)") from error
    return name, digest


def identity(sweep, rows):
    """The checksum of everything that decides results."""
    content = dataclasses.asdict(sweep) | {"id": ""}
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode())
    for row in rows:
        digest.update(("\0".join(row) + "\n").encode())
    return digest.hexdigest()[:16]


def write_plan(folder, sweep, rows, inputs):
    """Inputs, rows in blocks, and sweep.json last: a plan that has it is whole."""
    for part in ("inputs", "plan"):
        shutil.rmtree(folder / part, ignore_errors=True)
    shutil.copytree(inputs, folder / "inputs")
    (folder / "plan").mkdir()
    for block, part in enumerate(_blocks(rows)):
        with open(folder / "plan" / f"{block:03d}.csv", "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows(part)
    write_json(folder / "sweep.json", dataclasses.asdict(sweep))


def _blocks(rows):
    return (rows[i : i + BLOCK] for i in range(0, len(rows), BLOCK))


def write_json(path, content):
    """Whole or not at all, also when the machine loses power."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    with open(temporary, "w", encoding="utf-8") as file:
        json.dump(content, file, indent=1)
        file.write("\n")
        file.flush()
        os.fsync(file.fileno())
    os.replace(temporary, path)


def read_json(path, default=None):
    """What is in the file; the default if there is none."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return default
    except ValueError as error:  # no JSON, no UTF-8
        raise Problem(IO, f"{path}: {error}: remove it, and what made it is done again") from error


def read_sweep(folder):
    """Throws Problem where there is no sweep."""
    content = read_json(folder / "sweep.json")
    if content is None:
        raise Problem(USAGE, f"{folder}: no sweep is there (no sweep.json): give the folder that pipelines/sweep made")
    try:
        content["columns"] = [Column(**column) for column in content["columns"]]
        return Sweep(**content)
    except (KeyError, TypeError) as error:
        raise Problem(BAD_INPUT,
                      f"{folder}/sweep.json is of another version of pipelines/sweep ({error}): remove the"
                      f" folder") from error


def read_rows(folder, block):
    """The rows of the runs from block * BLOCK on."""
    with open(folder / "plan" / f"{block:03d}.csv", newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def read_row(folder, index):
    with open(folder / "plan" / f"{index // BLOCK:03d}.csv", newline="", encoding="utf-8") as file:
        return next(itertools.islice(csv.reader(file), index % BLOCK, None))
