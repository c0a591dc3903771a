# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a sweep is, from what lies in its folder."""
import collections
import os

from .plan import BLOCK, read_json, run_folder
from .run import is_locked, state


def states(folder, count):
    """The state of every run (see run.state), in order."""
    found = ["waiting"] * count
    for block in range((count + BLOCK - 1) // BLOCK):
        try:
            names = os.listdir(folder / "runs" / f"{block:03d}")
        except FileNotFoundError:
            continue
        for name in names:
            index = block * BLOCK + int(name)
            found[index] = state(run_folder(folder, index))
    return found


def failures(folder, found):
    """(index, exit code, reason) of each failed run."""
    for index, what in enumerate(found):
        if what == "failed":
            failed = read_json(run_folder(folder, index) / "failed.json")
            if failed:
                yield index, failed["exit_code"], failed["reason"]


def accounts(folder, found, among=("done",), most=200):
    """Accounts of some runs, spread evenly: of all when they are few."""
    indices = [i for i, what in enumerate(found) if what in among]
    step = max(1, len(indices) // most)
    read = (read_json(run_folder(folder, i) / "account.json") for i in indices[::step])
    return [account for account in read if account]


def summary(folder, sweep):
    """Lines to print: done, running, failed with reasons, time left."""
    found = states(folder, sweep.count)
    count = collections.Counter(found)
    begun = [i for i, what in enumerate(found) if what == "begun"]
    running = sum(is_locked(run_folder(folder, i)) for i in begun)
    left = sweep.count - count["done"] - count["failed"]
    line = (f"{sweep.count} runs: {count['done']} done, {running} running, {len(begun) - running} interrupted, "
            f"{count['failed']} failed, {count['waiting']} waiting")  # fmt: skip
    done = accounts(folder, found)
    if left and done:
        seconds = sum(a["seconds"] for a in done) / len(done) * left
        line += f"; about {told_time(seconds / max(1, running))} left" + ("" if running else " if one runs at a time")
    lines = [line]
    for index, code, reason in failures(folder, found):
        lines.append(f"  run {index} failed with exit code {code}: {reason}")
    return lines


def told_time(seconds):
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
