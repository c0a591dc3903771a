# SPDX-License-Identifier: GPL-3.0-or-later
"""Who runs the runs: this process (plain), GNU parallel on this machine, Slurm. (GNU parallel on other hosts:
hosts.py.)

Every engine gets indices of runs and ends when nothing is left that it could do; what has come of each run lies in its
folder. Several short runs make one job, a chunk, so that starting jobs costs little.
"""
import re
import shlex
import shutil
import statistics
import subprocess
import sys
import time

from .check import cores
from .plan import run_folder
from .problem import USAGE, Problem
from .run import Interrupted, do
from .status import accounts, states, summary

_CHUNK_SECONDS = 20  # a job shall take so long, where runs are short
_PATIENCE = 30  # seconds between two lines about how far it is


class Work:
    """What an engine needs to know: the sweep, its folder, the program that does chunks of it, threads a run, jobs."""

    def __init__(self, sweep, folder, program, threads, jobs):
        self.sweep, self.folder, self.program, self.threads = sweep, folder, program, threads
        self.told_jobs = jobs
        self.jobs = jobs or max(1, cores() // threads)

    def command(self):
        """For a shell, which shall add the indices of runs."""
        return shlex.join([str(self.program), "work", "--threads", str(self.threads), str(self.folder)])

    def needs(self):
        """(seconds, bytes) of the longest and largest of the runs that were tried; None if none was."""
        tried = accounts(self.folder, states(self.folder, self.sweep.count), among=("done", "failed", "begun"))
        return (max(a["seconds"] for a in tried), max(a["memory"] for a in tried)) if tried else None

    def chunks(self, indices, most=1_000_000):
        """Texts "3 4 5": as many runs each as take some seconds, but enough chunks for every worker to have several,
        and at most so many."""
        tried = accounts(self.folder, states(self.folder, self.sweep.count))
        seconds = statistics.mean(a["seconds"] for a in tried) if tried else _CHUNK_SECONDS
        size = max(1, min(int(_CHUNK_SECONDS / max(seconds, 1e-3)), len(indices) // (4 * self.jobs)),
                   -(-len(indices) // most))
        return [" ".join(map(str, indices[i : i + size])) for i in range(0, len(indices), size)]

    def say(self):
        print(summary(self.folder, self.sweep)[0], file=sys.stderr)


def plain(work, indices):
    """One after the other, in this process."""
    said = time.monotonic()
    for index in indices:
        try:
            do(work.sweep, work.folder, index, work.threads)
        except Interrupted as interrupted:
            print(interrupted, file=sys.stderr)
        if time.monotonic() - said > _PATIENCE:
            work.say()
            said = time.monotonic()


def parallel(work, indices):
    """GNU parallel. The first runs, one a job, tell how long and large the others will be."""
    _require("parallel", "parallel")
    trial = indices[: work.jobs] if not work.needs() else []
    if trial:
        _parallel(work, [str(i) for i in trial], [])
    rest = indices[len(trial) :]
    if rest:
        needs = work.needs()
        memory = ["--memfree", str(int(1.25 * needs[1]) + 1)] if needs and needs[1] else []
        _parallel(work, work.chunks(rest), memory)


def _parallel(work, chunks, options):
    command = ["setpriv", "--pdeathsig", "TERM", "parallel", "--will-cite", "--halt", "never", "--line-buffer",
               "--jobs", str(work.jobs), *options, work.command()]  # fmt: skip
    process = subprocess.Popen(command, stdin=subprocess.PIPE, text=True)
    try:
        process.stdin.write("\n".join(chunks) + "\n")
        process.stdin.close()
        wait(work, process)
    except BaseException:
        process.terminate()
        raise


def wait(work, process):
    while True:
        try:
            return process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            work.say()


def slurm(work, indices):
    """Job arrays, for time and memory that a trial run has taken. Waits for jobs that an earlier driver has left."""
    _require("sbatch", "slurm-wlm")
    name = f"sheet-{work.sweep.id}"
    if (queue := _slurm_queue(name)).returncode != 0:
        raise Problem(USAGE, f"Slurm does not answer here: {_last_line(queue.stderr)}: give the command on a machine of"
                             " the cluster, or take --engine parallel, which needs none")
    _slurm_wait(work, name)
    indices = [i for i in indices if not (run_folder(work.folder, i) / "result.json").exists()]
    if indices and not work.needs():
        _submit(work, name, [str(indices[0])], [])
        _slurm_wait(work, name)
        indices = indices[1:]
    if not indices:
        return
    seconds, memory = work.needs() or (60, 0)
    chunks = work.chunks(indices, _array_size())
    longest = max(len(chunk.split()) for chunk in chunks)
    asked = [f"--time={int(3 * seconds * longest / 60) + 2}"]
    if memory:
        asked.append(f"--mem={int(1.5 * memory / 2**20) + 64}M")
    _submit(work, name, chunks, asked)
    _slurm_wait(work, name)


def _submit(work, name, chunks, options):
    """One job array; what its tasks say goes to a folder of its own."""
    logs = work.folder / "slurm" / f"{time.time_ns():x}"
    logs.mkdir(parents=True)
    (logs / "chunks").write_text("\n".join(chunks) + "\n", encoding="utf-8")
    chunk = f"$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" {shlex.quote(str(logs / 'chunks'))})"
    script = f"#!/bin/sh\nexec {work.command()} {chunk}\n"
    command = ["sbatch", "--parsable", f"--job-name={name}", f"--array=0-{len(chunks) - 1}", "--requeue", "--ntasks=1",
               f"--cpus-per-task={work.threads}", f"--output={logs}/%a.log", *options]  # fmt: skip
    told = subprocess.run(command, input=script, text=True, capture_output=True)
    if told.returncode != 0:
        raise Problem(USAGE, f"sbatch refused the jobs: {told.stderr.strip()}")


def _slurm_wait(work, name):
    said = time.monotonic()
    while True:
        queue = _slurm_queue(name)
        if queue.returncode == 0 and not queue.stdout.strip():
            return
        time.sleep(1)
        if time.monotonic() - said > _PATIENCE:
            work.say()
            if queue.returncode != 0:  # its controller may come back
                print(f"Slurm does not answer: {_last_line(queue.stderr)}", file=sys.stderr)
            said = time.monotonic()


def _slurm_queue(name):
    return subprocess.run(["squeue", "--noheader", "--name", name, "--format=%i"], capture_output=True, text=True)


def _last_line(text):
    return (text.strip().splitlines() or ["it says nothing"])[-1]


def _array_size():
    told = subprocess.run(["scontrol", "show", "config"], capture_output=True, text=True).stdout
    match = re.search(r"MaxArraySize\s*=\s*(\d+)", told)
    return min(1000, int(match[1]) - 1) if match else 1000


def _require(program, package):
    if not shutil.which(program):
        raise Problem(USAGE, f"there is no program {program}: install Debian's package {package}, or take --engine"
                             f" plain")
