# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs what of a planned sweep is not complete, by the engine that was asked for."""
import fcntl
import os
import pathlib

from . import engines
from .engines import Work
from .hosts import parallel_hosts
from .plan import run_folder
from .problem import USAGE, Problem
from .run import retry
from .status import failures, states

ROOT = pathlib.Path(__file__).resolve().parents[2]


def find_programs():
    """Those of $SHEET_BIN, if there is one, come before those of build/bin and of the system."""
    places = [os.path.abspath(os.environ["SHEET_BIN"])] if os.environ.get("SHEET_BIN") else []
    os.environ["SHEET"] = str(ROOT)  # for commands that measure
    os.environ["PATH"] = ":".join([*places, str(ROOT / "build" / "bin"), os.environ["PATH"]])


def add_options(parser):
    """Those that say how runs are run."""
    parser.add_argument("--engine", choices=("parallel", "slurm", "plain"), default="parallel",
                        help="default: parallel")
    parser.add_argument("--hosts", metavar="HOST,...",
                        help="for --engine parallel: hosts that ssh reaches without a password")
    parser.add_argument("--there", metavar="FOLDER", default=str(ROOT),
                        help="where Sheet is built on the hosts (default: as here)")
    parser.add_argument("--jobs", type=int, default=0, metavar="N", help="runs at a time (default: one for each core)")
    parser.add_argument("--threads", type=int, default=1, metavar="N", help="threads of each run (default 1)")
    parser.add_argument("--retry", action="store_true", help="try again what has failed")


def passed_on(args):
    """The same options again, for a pipelines/sweep that is started."""
    options = ["--engine", args.engine, "--there", args.there, "--jobs", str(args.jobs), "--threads", str(args.threads)]
    return options + (["--hosts", args.hosts] if args.hosts else []) + (["--retry"] if args.retry else [])


def drive(args, sweep, folder):
    """Returns when nothing is left that could be done; what has come of it lies in the folder."""
    found = states(folder, sweep.count)
    if args.retry:
        for index, _, _ in failures(folder, found):
            retry(run_folder(folder, index))
        found = states(folder, sweep.count)
    indices = [i for i, what in enumerate(found) if what in ("waiting", "begun")]
    lock = open(folder / "driver.lock", "w")  # held as long as this process lives
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise Problem(USAGE, f"another pipelines/sweep is at {folder}: wait for it, or end it") from error
    work = Work(sweep, folder, ROOT / "pipelines" / "sweep", args.threads, args.jobs)
    if indices and args.hosts:
        if args.engine != "parallel":
            raise Problem(USAGE, "--hosts is for --engine parallel")
        parallel_hosts(work, indices, args.hosts.split(","), args.there)
    elif indices:
        getattr(engines, args.engine)(work, indices)
