# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of results.csv by gnuplot: curves or points over a column, or a map of two columns with a boundary in it."""
import csv
import math
import subprocess

from .problem import BAD_INPUT, INTERNAL, Problem


def read_results(path):
    """Rows of runs that are done, as dictionaries of texts."""
    with open(path, newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if row["state"] == "done"]


def column(rows, name):
    """The whole header, `NAME [UNIT]`, of the column that is called so, with its unit or without. Throws Problem."""
    headers = list(rows[0]) if rows else []
    found = [h for h in headers if name in (h, h.split(" [")[0])]
    if not found:
        raise Problem(BAD_INPUT,
                      f"the results have no column {name}; they have {', '.join(headers) or 'no run that is done'}")
    return found[0]


def finite(rows, *names):
    """The rows whose values in these columns are finite numbers; others cannot be drawn. Throws Problem if none are."""
    def drawn(text):
        try:
            return math.isfinite(float(text))
        except ValueError:
            return False

    kept = [row for row in rows if all(drawn(row[name]) for name in names)]
    if not kept:
        raise Problem(BAD_INPUT, f"no run has numbers in {', '.join(names)}")
    return kept


def curves(rows, x, y, by, log, lines, picture):
    """y over x; one curve (or one colour of points) for each value of the columns `by`, if there are any."""
    groups = {}
    for row in rows:
        groups.setdefault(", ".join(f"{name} {row[name]}" for name in by), []).append((float(row[x]), float(row[y])))
    data, parts = [], []
    for i, (title, points) in enumerate(groups.items()):
        data.append(f"$data{i} << END\n" + "".join(f"{a!r} {b!r}\n" for a, b in sorted(points)) + "END\n")
        style = "linespoints linewidth 2" if lines else "points"
        parts.append(f"$data{i} with {style} pointtype 7 linetype {i + 1} " + (f"title \"{_plain(title)}\"" if title
            else "notitle"))
    _draw(picture, [*data, _axes(x, y, log), "plot " + ", ".join(parts)])


def phase_map(rows, x, y, value, boundary, log, picture):
    """`value` in colours over x and y, a square a run, with the line where it is `boundary`, if that is given."""
    points = sorted({(float(r[x]), float(r[y])): float(r[value]) for r in rows}.items())
    xs, ys = sorted({p[0] for p, _ in points}), sorted({p[1] for p, _ in points})
    squares = [(*_around(xs, a, "x" in log), *_around(ys, b, "y" in log), v) for (a, b), v in points]
    low, high = min(v for _, v in points), max(v for _, v in points)
    script = ["set format cb '%.3g'\n$data << END\n" + "".join(f"{a!r} {b!r} {v!r}\n" for (a, b),
                                                               v in points) + "END\n", _axes(x, y, log),
              f"set cblabel \"{_plain(value)}\"",
              "set palette defined (0 '#30123b', 1 '#2f6ea5', 2 '#3fa89a', 3 '#a8cf5e', 4 '#fbe56a')",
              f"set cbrange [{low!r}:{high!r}]" if low < high else "",
              f"set xrange [{squares[0][0]!r}:{squares[-1][1]!r}]",
              f"set yrange [{_around(ys, ys[0], 'y' in log)[0]!r}:"
              f"{_around(ys, ys[-1], 'y' in log)[1]!r}]"]  # fmt: skip
    for axis, places in (("x", xs), ("y", ys)):
        if len(places) <= 12:
            script.append(f"set {axis}tics (" + ", ".join(f"{at:.3g}" for at in places) + ")")
    for i, (left, right, bottom, top, v) in enumerate(squares):
        script.append(f"set object {i + 1} rectangle from {left!r},{bottom!r} to {right!r},{top!r} behind fillcolor"
                      f" palette cb {v!r} "
                      "fillstyle solid noborder")  # fmt: skip
    lines = ["$data using 1:2:3 with points pointtype 7 pointsize 0.6 linecolor rgb \"white\" notitle"]
    if boundary is not None:
        segments = contour(dict(points), xs, ys, boundary, log)
        script.append("$line << END\n" + "".join(f"{a!r} {b!r}\n{c!r} {d!r}\n\n" for (a, b),
                                                 (c, d) in segments) + "END\n")
        if segments:
            lines.append(f"$line with lines linewidth 3 linecolor rgb \"red\" title \"{_plain(value)} = {boundary:g}\"")
    script.append("set key above; set colorbox; plot " + ", ".join(lines) + ", NaN with points palette notitle")
    _draw(picture, script)


def contour(values, xs, ys, level, log=""):
    """Pieces of the line where a function on a grid, linear along its edges, is `level`: pairs of points.

    values: {(x, y): value}; where a corner is missing there is no line. On logarithmic axes edges are cut in
    logarithms."""
    def cut(p, q):
        share = (level - values[p]) / (values[q] - values[p])
        return tuple(math.exp(math.log(a) + share * math.log(b / a)) if axis in log and a > 0 else a + share * (b - a)
                     for axis, a, b in zip("xy", p, q))  # fmt: skip

    pieces = []
    for left, right in zip(xs, xs[1:]):
        for low, high in zip(ys, ys[1:]):
            for corners in (((left, low), (right, low), (right, high)), ((left, low), (right, high), (left, high))):
                if all(c in values for c in corners):
                    crossed = [(p, q) for p, q in zip(corners, corners[1:] + corners[:1])
                               if (values[p] < level) != (values[q] < level)]
                    if len(crossed) == 2:
                        pieces.append(tuple(cut(p, q) for p, q in crossed))
    return pieces


def _around(places, at, log):
    """From the middle to the place before to that to the place behind."""
    i = places.index(at)
    middle = (lambda a, b: (a * b) ** 0.5) if log else (lambda a, b: (a + b) / 2)
    if len(places) == 1:
        return at * 0.9, at * 1.1
    beyond = (lambda a, b: a * a / b) if log else (lambda a, b: 2 * a - b)
    before = places[i - 1] if i > 0 else beyond(at, places[1])
    behind = places[i + 1] if i + 1 < len(places) else beyond(at, places[-2])
    return middle(before, at), middle(at, behind)


def _axes(x, y, log):
    scale = f"set logscale {log}\n" if log else ""
    return f"{scale}set xlabel \"{_plain(x)}\"; set ylabel \"{_plain(y)}\"; set key above Left reverse"


def _plain(text):
    return text.replace("\\", "").replace("\"", "").replace("_", "\\\\_").replace("^", "\\\\^")


def _draw(picture, script):
    head = f"set terminal pngcairo size 900, 600 font 'sans,12'; set output '{picture}'\n"
    head += "set grid linecolor rgb '#cccccc'\n"
    told = subprocess.run(["gnuplot"], input=head + "\n".join(script) + "\n", text=True, capture_output=True)
    if told.returncode != 0:
        raise Problem(INTERNAL, f"gnuplot: {told.stderr.strip()}")
