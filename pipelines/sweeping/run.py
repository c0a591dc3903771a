# SPDX-License-Identifier: GPL-3.0-or-later
"""One run of a sweep, in its folder:

    scene.toml      the scene whole, in SI units
    run.sheet       the stream, from its first frame on; every frame is a checkpoint
    log             what the programs said
    numbers.csv     sheet-info --csv of the stream
    result.json     exit code 0, steps, what was measured: the run is complete when this is there, and it is the same
                    however often the run was interrupted
    failed.json     instead: exit code and reason
    account.json    what it took: attempts, seconds, most memory at a time, host
    lock            held by everybody who works on the run: the worker, the ring and its stages
"""
import csv
import fcntl
import os
import re
import select
import socket
import subprocess
import time

from .plan import SCENE, filled, read_json, read_row, run_folder, settings, write_json
from .problem import CORRUPT, Problem

_ENDING = (1, 2, 9, 15)  # SIGHUP, SIGINT, SIGKILL, SIGTERM: who is ended by these has not failed
_UP = "../../.."  # from a run's folder to that of the sweep


class Failed(Exception):
    """A program of the run ended with a failure of its own."""

    def __init__(self, exit_code, reason):
        super().__init__(reason)
        self.exit_code = exit_code


class Interrupted(Exception):
    """It was ended from outside; the run can go on from where it is."""


def state(folder):
    """of a run, by what is there: waiting, done, failed, or begun (running or interrupted: see is_locked)."""
    try:
        names = os.listdir(folder)
    except FileNotFoundError:
        return "waiting"
    return "done" if "result.json" in names else "failed" if "failed.json" in names else "begun"


def is_locked(folder):
    """Whether somebody works on the run, on this machine (or on another one by a file system that tells)."""
    try:
        with open(folder / "lock", "rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except BlockingIOError:
        return True
    return False


def retry(folder):
    """Lets a failed run be tried again, from its last frame; from the beginning if its stream is damaged."""
    if read_json(folder / "failed.json")["exit_code"] == CORRUPT:
        (folder / "run.sheet").unlink(missing_ok=True)
    (folder / "failed.json").unlink()


def do(sweep, folder, index, threads):
    """Does the run, or what is missing of it, or nothing. Waits while somebody else is at it."""
    path = run_folder(folder, index)
    path.mkdir(parents=True, exist_ok=True)
    with open(path / "lock", "a+b") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if state(path) != "begun":
            return
        lock.truncate(0)
        lock.write(str(os.getpid()).encode())
        lock.flush()
        _Attempt(sweep, folder, path, index, threads, lock).make()


class _Attempt:
    def __init__(self, sweep, folder, path, index, threads, lock):
        self.sweep, self.path, self.index, self.threads, self.lock = sweep, path, index, threads, lock
        self.row = read_row(folder, index)
        self.memory = 0  # most at a time [bytes]

    def make(self):
        begin = time.monotonic()
        try:
            with open(self.path / "log", "ab") as self.log:
                outcome, name = self._result(), "result.json"
        except Failed as failure:
            outcome, name = {"exit_code": failure.exit_code, "reason": str(failure)}, "failed.json"
        except (Interrupted, KeyboardInterrupt, SystemExit):
            self._account(time.monotonic() - begin)
            raise
        self._account(time.monotonic() - begin)
        write_json(self.path / name, outcome)

    def _result(self):
        if self.sweep.command:
            self._program(["bash", "-c", filled(self.sweep.command, self.sweep, self.row)])
            return {"exit_code": 0, "steps": 0, "measures": {}}
        self._first_frame()
        loop = [filled(option, self.sweep, self.row) for option in self.sweep.loop]
        ring = with_threads(filled(self.sweep.ring, self.sweep, self.row), self.threads)
        self._program(["sheet-loop", "--threads", str(self.threads), "--resume", "run.sheet", *loop, "--", ring])
        self._program(["sheet-info", "--threads", str(self.threads), "--csv", "run.sheet", "-o", "numbers.csv"])
        with open(self.path / "numbers.csv", newline="", encoding="utf-8") as file:
            series = list(csv.DictReader(file))
        return {"exit_code": 0, "steps": int(series[-1]["step"]), "measures": _extremes(series) | self._measured()}

    def _first_frame(self):
        if (self.path / "run.sheet").exists():
            return
        told = [part for text in settings(self.sweep, self.row) for part in ("--set", text)]
        scene = f"{_UP}/inputs/{SCENE}"
        self._program(["sheet-init", "--threads", str(self.threads), scene, *told, "-o", "start.sheet"])
        printed = self._program(["sheet-print", "start.sheet"], keep=True)
        scene = re.search(r"^array scene .*\n((?:\|.*\n)*)", printed, re.MULTILINE)[1]
        (self.path / "scene.toml").write_text(re.sub(r"^\| ?", "", scene, flags=re.MULTILINE), encoding="utf-8")
        os.replace(self.path / "start.sheet", self.path / "run.sheet")

    def _measured(self):
        """Of lines "NAME VALUE" or "NAME [UNIT] VALUE" that the user's command prints: {"NAME [UNIT]": VALUE}."""
        if not self.sweep.measure:
            return {}
        measures = {}
        for line in self._program(["bash", "-c", filled(self.sweep.measure, self.sweep, self.row)],
                                  keep=True).splitlines():
            match = re.fullmatch(r"\s*([\w.]+(?:\s+\[[^\]]+\])?)\s+(\S+)\s*", line)
            if not match:
                raise Failed(3,
                             f"the command that measures printed \"{line}\"; expected NAME VALUE or NAME [UNIT] VALUE")
            measures[re.sub(r"\s+", " ", match[1])] = match[2]
        return measures

    def _program(self, command, keep=False):
        """Runs it in the run's folder; its messages go to the log. Returns what it printed, if that is kept."""
        self.log.flush()
        begin = self.log.tell()
        process = subprocess.Popen(command, cwd=self.path, stdin=subprocess.DEVNULL, stderr=self.log, text=True,
                                   stdout=subprocess.PIPE if keep else self.log, pass_fds=(self.lock.fileno(),
                                       ))  # fmt: skip
        try:
            printed = process.communicate()[0] if keep else self._watched(process)
        except BaseException:
            process.terminate()
            raise
        code = process.returncode
        if code == 0:
            return printed
        with open(self.path / "log", "rb") as file:
            file.seek(begin)
            told = file.read().decode(errors="replace").strip()
        by_signal = re.findall(r"was ended by signal (\d+)", told)
        if -code in _ENDING or code - 128 in _ENDING or (by_signal and int(by_signal[-1]) in _ENDING):
            raise Interrupted(f"run {self.index}: {told.splitlines()[-1] if told else f'ended by signal {-code}'}")
        raise Failed(code if code > 0 else 1, told.splitlines()[-1] if told
                     else f"{command[0]} ended by signal {-code}")

    def _watched(self, process):
        """Waits; meanwhile looks at its memory and that of its children, often at first."""
        ended = select.poll()
        descriptor = os.pidfd_open(process.pid)
        ended.register(descriptor, select.POLLIN)
        pause = 50
        while not ended.poll(pause):
            self.memory = max(self.memory, _memory(process.pid))
            pause = min(2 * pause, 2000)
        os.close(descriptor)
        process.wait()

    def _account(self, seconds):
        account = read_json(self.path / "account.json") or {"attempts": 0, "seconds": 0, "memory": 0}
        write_json(self.path / "account.json", {
            "attempts": account["attempts"] + 1, "seconds": round(account["seconds"] + seconds, 3),
            "memory": max(account["memory"], self.memory), "host": socket.gethostname()})  # fmt: skip


def with_threads(ring, threads):
    """Every program of Sheet in the ring is told its number of threads, where it does not say one itself."""
    told = lambda stage: "--threads" in stage or not re.match(r"\s*sheet-", stage)  # noqa: E731
    return "|".join(s if told(s) else f"{s.rstrip()} --threads {threads} " for s in ring.split("|")).rstrip()


def _extremes(series):
    """Last, least and greatest value of what sheet-info measures: {"end.area [m^2]": "0.025"}."""
    measures = {}
    for name in series[0]:
        if name in ("frame", "step"):
            continue
        unit = f" [{unit_of(name)}]" if unit_of(name) else ""
        values = [row[name] for row in series]
        measures[f"end.{name}{unit}"] = values[-1]
        if name not in ("time", "closed"):
            measures[f"min.{name}{unit}"] = min(values, key=float)
            measures[f"max.{name}{unit}"] = max(values, key=float)
    return measures


def unit_of(column):
    """The SI unit of a column of sheet-info --csv; "" for counts and ratios."""
    units = {
        r"time": "s", r"area": "m^2", r"volume|enclosed_volume": "m^3", r"kinetic_energy": "J", r"momentum_.": "kg*m/s",
        r"angular_momentum_.": "kg*m^2/s", r"force_of_.*_[xyz]": "N",
        r"thickness_.*|edge_.*|[xyz]_(min|max)": "m", r"angle_.*": "deg",
    }  # fmt: skip
    return next((unit for pattern, unit in units.items() if re.fullmatch(pattern, column)), "")


def _memory(pid):
    """Most resident memory [bytes] so far of a process and its children, each one's own peak."""
    total = 0
    try:
        children = []
        for task in os.listdir(f"/proc/{pid}/task"):
            with open(f"/proc/{pid}/task/{task}/children", encoding="ascii") as file:
                children += file.read().split()
        for process in (pid, *children):
            with open(f"/proc/{process}/status", encoding="ascii", errors="replace") as file:
                peak = re.search(r"VmHWM:\s+(\d+)", file.read())
            total += 1024 * int(peak[1]) if peak else 0
    except OSError:
        return 0  # it has just ended
    return total
