# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that can be told to be wrong with a sweep before anything runs, all of it at once."""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile

from .plan import SCENE, filled, names_in, settings
from .problem import BAD_INPUT, USAGE, Problem
from .table import duplicates

_TOLD = 20  # problems of rows that are printed; how many more there are is said


def scene_keys():
    """What sheet-init knows of the keys of scenes: {key without numbers of tables: (kind, unit)}."""
    listed = [line.split("\t") for line in _told(["sheet-init", "--list-keys"]).splitlines()]
    return {key.replace(".N.", "."): (kind, unit) for key, kind, unit, _ in listed}


def declared(keys, key):
    """(kind, unit) of a key as --set takes it; of an item of a list ("sheet.center.1") those of the item, ("", "") of
    none."""
    names = key.split(".")
    while names[-1].isdecimal() and len(names) > 1:
        names.pop()
    kind, unit = keys.get(".".join(name for name in names if not name.isdecimal()), ("", ""))
    return (kind, unit) if len(key.split(".")) - len(names) == kind.count("[") else ("", "")


def is_file(keys, key):
    return declared(keys, key)[0].startswith("file")


def named_files(scene, sets):
    """The files that the scene names after these settings: {key: path}."""
    given = [part for text in sets for part in ("--set", text)]
    lines = _told(["sheet-init", "--list-files", scene, *given]).splitlines()
    return {key: pathlib.Path(path) for path, key in (line.split("\t") for line in lines)}


def _told(command):
    """What the command prints. Throws Problem if it fails."""
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise Problem(BAD_INPUT, re.sub(r"^sheet-init: ", "", done.stderr.strip(), flags=re.MULTILINE))
    return done.stdout


def check_all(sweep, table, path, inputs):
    """Throws one Problem with all that is wrong; of many rows that are, the first few are told."""
    names = _names(sweep, path)
    problems = names + _stages(sweep.ring) + duplicates(table) + _rows(sweep, table, inputs)
    problems += [] if names else _loop(sweep, table)
    if problems:
        told = problems[:_TOLD]
        if len(problems) > _TOLD:
            told.append(f"and {len(problems) - _TOLD} more")
        raise Problem(BAD_INPUT, "\n".join(told))


def _names(sweep, path):
    """Names in braces that are no columns, columns that nothing uses."""
    keys = [column.key for column in sweep.columns]
    wrong = []
    for text in sweep.texts():
        for name in names_in(text):
            if name not in keys:
                wrong.append(f"{path}: there is no column {name}, which {{{name}}} in \"{text}\" asks for")
    used = {name for text in sweep.texts() for name in names_in(text)}
    for column in sweep.columns:
        if "." not in column.key and column.key not in used:
            wrong.append(f"{path}: column {column.key}: unknown: no key of the scene (those have a dot), and nothing "
                         f"asks for {{{column.key}}}")  # fmt: skip
    return list(dict.fromkeys(wrong))


def _loop(sweep, table):
    """What sheet-loop refuses of its options, as the first row has them."""
    options = [filled(option, sweep, table.rows[0]) for option in sweep.loop]
    command = ["sheet-loop", *options, "-i", os.devnull, "-o", os.devnull, "--", "true"]
    done = subprocess.run(command, capture_output=True, text=True)
    return [line.removeprefix("sheet-loop: ") for line in done.stderr.splitlines()] if done.returncode == USAGE else []


def _stages(ring):
    """Stages of the ring that are not there."""
    wrong = []
    for stage in ring.split("|"):
        try:
            word = (shlex.split(stage) or [""])[0]
        except ValueError as error:
            return [f"the ring \"{ring}\": {error}"]
        if "/" in word and not os.path.isabs(word):
            wrong.append(f"the ring \"{ring}\": {word} would be looked for in each run's folder: give its whole path")
        elif not shutil.which(word):
            wrong.append(f"the ring \"{ring}\": there is no program \"{word}\"")
    return wrong


def set_units(sweep, keys):
    """Columns that are keys of the scene get the SI unit of their quantity, where they have none."""
    for column in sweep.columns:
        column.unit = column.unit or declared(keys, column.key)[1]


def _rows(sweep, table, inputs):
    """What sheet-init refuses, once for each thing that is wrong, with the place of the first row where it is."""
    every = range(len(table.rows))
    wrong = _refused(sweep, table, inputs, [every[i :: cores()] for i in range(cores())])
    rows = {}
    for i, text in wrong:
        rows.setdefault(re.sub(r"--set ([^=]*)=.*?: ", r"\1: ", text), []).append((i, text))
    problems = []
    for same in rows.values():
        more = f" (and {len(same) - 1} more alike)" if len(same) > 1 else ""
        problems.append(f"{table.places[same[0][0]]}: {same[0][1]}{more}")
    return problems


def _refused(sweep, table, inputs, parts):
    """(row, message) of what `sheet-init --check-rows` refuses; every part of the rows is looked at by one process."""
    processes = []
    for part in parts:
        with tempfile.TemporaryFile("w+", encoding="utf-8") as file:
            for i in part:
                file.write("\t".join(settings(sweep, table.rows[i])) + "\n")
            file.seek(0)
            command = ["sheet-init", "--threads", "1", "--check-rows", "-", inputs / SCENE]
            processes.append((part, subprocess.Popen(command, stdin=file, stderr=subprocess.PIPE, text=True)))
    found = []
    for part, process in processes:
        told = process.communicate()[1]
        lines = [re.fullmatch(r"sheet-init: standard input:(\d+): (.*)", line) for line in told.splitlines()]
        if process.returncode not in (0, BAD_INPUT) or not all(lines):
            raise Problem(process.returncode or BAD_INPUT, f"sheet-init cannot check the rows: {told.strip()}")
        found += [(part[int(match[1]) - 1], match[2]) for match in lines]
    return sorted(found)


def cores():
    return len(os.sched_getaffinity(0))
