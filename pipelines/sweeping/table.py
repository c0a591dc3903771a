# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a table of parameters: one row a run, one column a key of the scene or a name for {name} in commands.

CSV: the first line names the columns, `KEY` or `KEY [UNIT]`; a number in a column with a unit has that unit.
TOML: [grid] every combination, [zip] lists that go together, [random] and [latin_hypercube] `count` points by `seed`;
values are lists, or {from, to, count, scale = "linear" or "log"} (in the last two without count). Tables that stand
side by side are combined, every row of one with every row of the others.
"""
import csv
import dataclasses
import itertools
import math
import random
import re
import tomllib

from .problem import BAD_INPUT, IO, Problem

_HEADER = re.compile(r"\s*([A-Za-z_][\w.]*)\s*(?:\[\s*([^\]]+?)\s*\])?\s*")
_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*")
_WAYS = ("grid", "zip", "random", "latin_hypercube")
_MOST_ROWS = 1_000_000


@dataclasses.dataclass
class Column:
    """`key` is one of the scene if it has a dot, else a name for {key}; `unit` is that of plain numbers ("": SI)."""

    key: str
    unit: str = ""
    is_file: bool = False  # the values name files

    def in_scene(self):
        return "." in self.key


@dataclasses.dataclass
class Table:
    """`rows[i][j]` is the text of column j for run i; `places[i]` says where in the file that row is."""

    columns: list
    rows: list
    places: list


def number(text):
    """The number, or None if the text is not a plain one."""
    match = _NUMBER.fullmatch(text)
    return float(match[1]) if match and not match[2] else None


def read_table(path):
    """Throws Problem: unreadable, or all that is wrong with its form (what the scene says of it is asked later)."""
    try:
        if path.suffix == ".toml":
            table = _from_toml(path, tomllib.loads(path.read_text(encoding="utf-8-sig")))
        else:
            with open(path, newline="", encoding="utf-8-sig") as file:
                table = _from_csv(path, file)
    except OSError as error:
        raise Problem(IO, f"{path}: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, csv.Error) as error:
        raise Problem(BAD_INPUT, f"{path}: {error}") from error
    if not table.rows:
        raise Problem(BAD_INPUT, f"{path}: no rows: at least one run is needed")
    if len(table.rows) > _MOST_ROWS:
        raise Problem(BAD_INPUT,
                      f"{path}: {len(table.rows)} rows; at most {_MOST_ROWS} fit one sweep: cut the table in parts")
    return table


def separators_are_wrong(header):
    """What is wrong with a CSV file whose first line is this text, if it is not of commas; else ""."""
    marks = [name for mark, name in ((";", "semicolons"), ("\t", "tabs")) if mark in header and "," not in header]
    return f"columns are separated by commas, not by {marks[0]}; numbers have a decimal point" if marks else ""


def duplicates(table):
    """A message for every row that says the same as one before it."""
    seen, found = {}, []
    for row, place in zip(table.rows, table.places):
        same = tuple(value if (x := number(value)) is None else x for value in row)
        if same in seen:
            found.append(f"{place}: the same as {seen[same]}: remove one of them")
        else:
            seen[same] = place
    return found


def _column(path, text, problems):
    match = _HEADER.fullmatch(text)
    if not match:
        problems.append(f"{path}:1: column \"{text}\": expected KEY or KEY [UNIT], such as material.viscosity [Pa*s]")
        return Column(text)
    return Column(match[1], match[2] or "")


def _from_csv(path, file):
    reader = csv.reader(file, skipinitialspace=True)
    header = next(reader, [])
    if wrong := separators_are_wrong(",".join(header)):
        raise Problem(BAD_INPUT, f"{path}:1: {wrong}")
    problems, rows, places = [], [], []
    columns = [_column(path, text, problems) for text in header]
    problems += _repeated(path, columns)
    for row in reader:
        place = f"{path}:{reader.line_num}"
        if not row:
            continue
        if len(row) != len(columns):
            problems.append(f"{place}: {len(row)} values for {len(columns)} columns")
            continue
        row = [value.strip() for value in row]
        problems += [f"{place}: {c.key}: no value" for c, value in zip(columns, row) if not value]
        rows.append(row)
        places.append(place)
    if problems:
        raise Problem(BAD_INPUT, "\n".join(problems))
    return Table(columns, rows, places)


def _repeated(path, columns):
    keys = [column.key for column in columns]
    return [f"{path}:1: column \"{key}\" stands there twice" for key in dict.fromkeys(keys) if keys.count(key) > 1]


def _from_toml(path, document):
    problems = [f"{path}: unknown table [{name}]; known: {', '.join(_WAYS)}" for name in document if name not in _WAYS]
    blocks = []
    for way in _WAYS:
        if way in document:
            blocks.append(_Block(path, way, document[way], problems).rows())
    if problems:
        raise Problem(BAD_INPUT, "\n".join(problems))
    columns = [Column(key) for keys, _ in blocks for key in keys]
    if problems := _repeated(path, columns):
        raise Problem(BAD_INPUT, "\n".join(problems))
    if math.prod(len(rows) for _, rows in blocks) > _MOST_ROWS:
        raise Problem(BAD_INPUT, f"{path}: more than {_MOST_ROWS} rows do not fit one sweep: cut the table in parts")
    rows = [list(itertools.chain(*parts)) for parts in itertools.product(*(rows for _, rows in blocks))]
    places = [f"{path}: row {i + 1} ({', '.join(f'{c.key} = {v}' for c, v in zip(columns, row))})" for i,
              row in enumerate(rows)]
    return Table(columns, rows, places)


class _Block:
    """One of the tables [grid], [zip], [random], [latin_hypercube] of a TOML file."""

    def __init__(self, path, way, content, problems):
        self.where, self.way, self.problems = f"{path}: [{way}]", way, problems
        self.count = self.seed = None
        if way in ("random", "latin_hypercube"):
            content = dict(content)
            self.count, self.seed = content.pop("count", None), content.pop("seed", 1)
            if not isinstance(self.count, int) or self.count < 1:
                self._wrong("count", "expected how many points to take, such as count = 100")
                self.count = 1
        self.values = dict(self._flat(content, ""))

    def _wrong(self, key, text):
        self.problems.append(f"{self.where} {key}: {text}")

    def _flat(self, content, prefix):
        for key, value in content.items():
            if isinstance(value, dict) and not {"from", "to"} & value.keys():
                yield from self._flat(value, f"{prefix}{key}.")
            else:
                yield prefix + key, value

    def rows(self):
        """(keys, rows of texts)."""
        keys = list(self.values)
        if self.way in ("grid", "zip"):
            lists = [self._list(key, value) for key, value in self.values.items()]
            if self.way == "grid":
                return keys, list(itertools.product(*lists))
            if len(set(map(len, lists))) > 1:
                told = ", ".join(f"{k} {len(v)}" for k, v in zip(keys, lists))
                self.problems.append(f"{self.where}: lists that go together must be equally long: {told}")
            return keys, list(zip(*lists))
        generator = random.Random(self.seed)
        shares = [self._shares(generator) for _ in keys]
        ranges = [self._range(key, value) for key, value in self.values.items()]
        return keys, [[r(share) for r, share in zip(ranges, point)] for point in zip(*shares)]

    def _shares(self, generator):
        """Where in 0 to 1 the points are along one key; for the hypercube one in each of `count` equal parts."""
        if self.way == "random":
            return [generator.random() for _ in range(self.count)]
        parts = list(range(self.count))
        generator.shuffle(parts)
        return [(part + generator.random()) / self.count for part in parts]

    def _list(self, key, value):
        if isinstance(value, list) and value:
            return [_text(v) for v in value]
        count = value.get("count") if isinstance(value, dict) else None
        if not isinstance(count, int) or count < 2:
            self._wrong(key, "expected a list, or {from = ..., to = ..., count = 2 or more, scale = \"linear\" or"
                             " \"log\"}")
            return [""]
        at = self._range(key, {k: v for k, v in value.items() if k != "count"})
        return [at(i / (count - 1)) for i in range(count)]

    def _range(self, key, value):
        """A function from 0 to 1 to the text of the value there."""
        expected = "expected {from = ..., to = ..., scale = \"linear\" or \"log\"}, two numbers of one unit"
        ends = []
        if isinstance(value, dict) and value.keys() <= {"from", "to", "scale"}:
            ends = [_NUMBER.fullmatch(_text(value.get(end, ""))) for end in ("from", "to")]
        if len(ends) != 2 or not all(ends) or ends[0][2] != ends[1][2]:
            self._wrong(key, expected)
            return lambda share: ""
        low, high, scale = float(ends[0][1]), float(ends[1][1]), value.get("scale", "linear")
        if scale not in ("linear", "log") or (scale == "log" and not 0 < low * high):
            self._wrong(key, f"{expected}; for \"log\" both of one sign and not 0")
            return lambda share: ""
        unit = f" {ends[0][2]}" if ends[0][2] else ""
        if scale == "log":
            return lambda share: f"{low * (high / low) ** share:.9g}{unit}"
        return lambda share: f"{low + (high - low) * share:.9g}{unit}"


def _text(value):
    """As sheet-init's --set takes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return "[" + ", ".join(f'"{v}"' if isinstance(v, str) else _text(v) for v in value) + "]"
    return value if isinstance(value, str) else repr(value)
