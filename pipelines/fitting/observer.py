# SPDX-License-Identifier: GPL-3.0-or-later
"""What would be measured of a scene, setting by setting, by runs of a sweep."""
import csv
import hashlib
import io
import pathlib
import subprocess

import numpy

from sweeping import plan
from sweeping.problem import Problem

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Observer:
    """Runs the scene for many settings at a time, as one sweep in a folder of its own, and reads what was measured."""

    def __init__(self, asked, folder, passed):
        self.asked, self.folder, self.passed = asked, folder, passed

    def __call__(self, settings):
        text = io.StringIO()
        writer = csv.writer(text)
        writer.writerow([f"{key} [{unit}]" if unit else key for key, unit in self.asked.units.items()])
        writer.writerows([[repr(row[key]) for key in self.asked.units] for row in settings])
        # A name by all that is run, so that the same is found again and another question finds nothing.
        scene = self.asked.scene.read_bytes()
        asked = repr((text.getvalue(), scene, self.asked.ring, self.asked.loop, self.asked.sets))
        folder = self.folder / f"batch-{hashlib.sha256(asked.encode()).hexdigest()[:12]}"
        folder.mkdir(parents=True, exist_ok=True)
        table = folder / "table.csv"
        table.write_text(text.getvalue(), encoding="utf-8", newline="")
        self._sweep(table, folder / "sweep")
        return [self._observed(plan.run_folder(folder / "sweep", i)) for i in range(len(settings))]

    def _sweep(self, table, folder):
        asked = self.asked
        command = [str(ROOT / "pipelines" / "sweep"), str(table), "--scene", str(asked.scene), *asked.loop,
                   "-o", str(folder), *self.passed]  # fmt: skip
        command += [part for text in asked.sets for part in ("--set", text)]
        done = subprocess.run([*command, "--", asked.ring], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              text=True, check=False)
        if done.returncode != 0:
            raise Problem(done.returncode, f"{done.stderr.strip()}\nthe sweep is in {folder}")

    def _observed(self, run):
        with open(run / "numbers.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        times = numpy.array([float(row["time"]) for row in rows])
        return numpy.concatenate([self._one(measured, run, times, rows) for measured in self.asked.measured])

    @staticmethod
    def _one(measured, run, times, rows):
        if measured.observer not in rows[0]:
            raise Problem(3, f"{measured.place}: no observer {measured.observer}; sheet-info --csv has "
                          f"{', '.join(rows[0])}")  # fmt: skip
        if measured.times.min() < times[0] - 1e-12 or measured.times.max() > times[-1] * (1 + 1e-9):
            raise Problem(3, f"{measured.place}: times from {measured.times.min():g} to {measured.times.max():g} s, but"
                          f" {run} goes from {times[0]:g} to {times[-1]:g} s")  # fmt: skip
        return numpy.interp(measured.times, times, [float(row[measured.observer]) for row in rows])
