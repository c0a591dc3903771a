# SPDX-License-Identifier: GPL-3.0-or-later
"""CSV files of the pipelines as rows with columns by name, for scripts beside them and in their folders."""
import csv
import math


def read(path):
    """A dictionary for each row: numbers (nan where there is none) where all of a column's values are such, else texts.
    Units in brackets behind a column's name are left out of it."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    columns = {name: [row[name] for row in rows] for name in (rows[0] if rows else ())}
    for name, values in columns.items():
        try:
            columns[name] = [float(value or math.nan) for value in values]
        except ValueError:
            pass
    names = [name.split(" [")[0] for name in columns]
    return [dict(zip(names, row)) for row in zip(*columns.values())]


def slope(points):
    """Of the line through (x, y), by least squares; nan of less than two."""
    n, a, b = len(points), sum(x for x, _ in points), sum(y for _, y in points)
    if n < 2:
        return float("nan")
    return (n * sum(x * y for x, y in points) - a * b) / (n * sum(x * x for x, _ in points) - a * a)
