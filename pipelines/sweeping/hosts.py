# SPDX-License-Identifier: GPL-3.0-or-later
"""GNU parallel on several hosts by ssh. Every host has Sheet of its own; runs are sent there and come home whole.

    versions   the programs there are compared with those here before anything starts
    settle     what an earlier driver has left there is ended and brought home, done or begun
    push       the plan, the inputs and the runs that were begun go to every host
    serve      does some runs there and prints their folders as a tar file, which parallel keeps in incoming/
    receive    unpacks such a file beside, and renames each run into its place: a file that was cut short changes
    nothing
The ssh program is that of GNU parallel: PARALLEL_SSH, or ssh.
"""
import hashlib
import io
import os
import pathlib
import shlex
import shutil
import signal
import subprocess
import sys
import tarfile
import time

from .check import cores
from .plan import BLOCK, read_sweep, run_folder
from .problem import IO, USAGE, Problem
from .run import Interrupted, do, is_locked, state
from .status import states

_ENDMARK = "whole"  # the last member of a tar file of runs
_NOT_SENT = ("lock", "start.sheet")


def parallel_hosts(work, indices, hosts, there):
    """Like engines.parallel, on hosts; `there` is the folder of Sheet on them."""
    far = _Hosts(work, hosts, there)
    far.compare_versions()
    far.settle()
    left, before = _left(work, indices), None
    while left and left != before:  # what was interrupted goes on while something comes of it
        far.push(left)
        far.run(left)
        far.settle()
        left, before = _left(work, left), left
    if states(work.folder, work.sweep.count).count("done") == work.sweep.count:
        for host in hosts:
            far.call(host, "clear", far.place)


def _left(work, indices):
    return [i for i in indices if state(run_folder(work.folder, i)) in ("waiting", "begun")]


class _Hosts:
    def __init__(self, work, hosts, there):
        self.work, self.hosts, self.there = work, hosts, there
        self.place = f"out/sweeps/{work.sweep.id}"  # of this sweep, there
        self.jobs = {}

    def command(self, *words):
        return f"cd {shlex.quote(self.there)} && pipelines/sweep {shlex.join(words)}"

    def call(self, host, *words, **options):
        ssh = shlex.split(os.environ.get("PARALLEL_SSH", "ssh"))
        done = subprocess.run([*ssh, "-o", "BatchMode=yes", host, self.command(*words)], capture_output=True, **options)
        if done.returncode != 0:
            told = done.stderr.decode(errors="replace").strip()
            raise Problem(IO, f"host {host}: {' '.join(words[:1])} ended with {done.returncode}:"
                              f" {told or 'no message'}\n"
                          f"see that `{shlex.join(ssh)} {host}` works without a password, and that Sheet is in"
                          f" {self.there} there")  # fmt: skip
        return done.stdout

    def compare_versions(self):
        words = programs_of(self.work.sweep.ring) if self.work.sweep.ring else ["sheet-render"]
        here, wrong = versions(words), []
        for host in self.hosts:
            number, *lines = self.call(host, "versions", *words).decode().splitlines()
            self.jobs[host] = self.work.told_jobs or max(1, int(number) // self.work.threads)
            wrong += [f"host {host}: {word} is {b}, here {a}: build the same version there" for word, a,
                      b in zip(words, here, lines) if a != b]
        if wrong:
            raise Problem(USAGE, "\n".join(wrong))

    def settle(self):
        for host in self.hosts:
            receive(self.work.folder, io.BytesIO(self.call(host, "settle", self.place)))

    def push(self, indices):
        folder = self.work.folder
        packed = io.BytesIO()
        with tarfile.open(fileobj=packed, mode="w") as tar:
            for part in ("plan", "inputs", "sweep.json"):
                tar.add(folder / part, part)
            for index in indices:
                if state(run_folder(folder, index)) == "begun":
                    _pack(tar, folder, index)
        for host in self.hosts:
            self.call(host, "unpack", self.place, input=packed.getvalue())

    def run(self, indices):
        incoming = self.work.folder / "incoming"
        shutil.rmtree(incoming, ignore_errors=True)
        incoming.mkdir()
        logins = [part for host in self.hosts for part in ("--sshlogin", f"{self.jobs[host]}/{host}")]
        self.work.jobs = sum(self.jobs.values())
        command = ["setpriv", "--pdeathsig", "TERM", "parallel", "--will-cite", "--halt", "never", "--files",
                   "--tmpdir", str(incoming),
                   *logins, self.command("serve", str(self.work.threads), self.place)]  # fmt: skip
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        process.stdin.write("\n".join(self.work.chunks(indices)) + "\n")
        process.stdin.close()
        for line in process.stdout:
            with open(line.strip(), "rb") as file:
                receive(self.work.folder, file)
            os.unlink(line.strip())
        process.wait()


def programs_of(ring):
    """What decides the bits of a run: the programs that are started, by the first word of each stage."""
    return list(dict.fromkeys(["sheet-init", "sheet-print", "sheet-info", "sheet-loop",
                               *(shlex.split(s)[0] for s in ring.split("|"))]))


def versions(words):
    """What each program says of its version, and the beginning of its checksum."""
    found = []
    for word in words:
        path = shutil.which(word)
        if not path:
            found.append("not there")
            continue
        told = subprocess.run([path, "--version"], capture_output=True,
                              text=True).stdout.split("\n")[0] if word.startswith("sheet-") else word
        with open(path, "rb") as file:
            found.append(f"{told}, SHA-256 {hashlib.file_digest(file, 'sha256').hexdigest()[:12]}")
    return found


def _pack(tar, folder, index):
    path = run_folder(folder, index)
    tar.add(path, path.relative_to(folder), filter=lambda member: None if os.path.basename(member.name) in _NOT_SENT
            else member)


def receive(folder, file):
    """Takes the runs of a tar file over, if it is whole. What is complete here stays; what came is renamed into
    place."""
    beside = folder / "incoming" / f"unpacked.{os.getpid()}"
    shutil.rmtree(beside, ignore_errors=True)
    try:
        with tarfile.open(fileobj=file, mode="r|") as tar:
            tar.extractall(beside)
    except (tarfile.TarError, EOFError, OSError):
        return
    if (beside / _ENDMARK).exists():
        for came in sorted((beside / "runs").glob("*/*")):
            place = folder / came.relative_to(beside)
            if state(place) in ("done", "failed") or (state(place) == "begun" and _size(place) >= _size(came)
                                                      and state(came) == "begun"):
                continue
            place.parent.mkdir(parents=True, exist_ok=True)
            if place.exists():
                os.rename(place, beside / f"old.{came.parent.name}.{came.name}")
            os.rename(came, place)
    shutil.rmtree(beside, ignore_errors=True)


def _size(place):
    """Of the stream so far: of two that were begun, the longer one has more frames."""
    try:
        return (place / "run.sheet").stat().st_size
    except FileNotFoundError:
        return 0


def _send(folder, indices):
    """Prints the runs as a tar file."""
    with tarfile.open(fileobj=sys.stdout.buffer, mode="w|") as tar:
        for index in indices:
            if state(run_folder(folder, index)) != "waiting":
                _pack(tar, folder, index)
        tar.addfile(tarfile.TarInfo(_ENDMARK))


def serve(sweep, folder, threads, indices):
    """On the host: does the runs, prints them."""
    for index in indices:
        try:
            do(sweep, folder, index, threads)
        except Interrupted as interrupted:
            print(interrupted, file=sys.stderr)
    _send(folder, indices)


def settle(folder):
    """On the host: ends what still works on runs there, prints all runs."""
    runs = sorted(int(path.parent.name) * BLOCK + int(path.name) for path in (folder / "runs").glob("*/*"))
    for index in runs:
        for number in (signal.SIGTERM, signal.SIGKILL):
            if is_locked(run_folder(folder, index)):
                _end_holders(run_folder(folder, index) / "lock", number)
    _send(folder, runs)


def _end_holders(lock, number):
    """Signals the processes that have the lock open, and waits some seconds for it to become free."""
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            opened = [os.readlink(f"/proc/{process}/fd/{fd}") for fd in os.listdir(f"/proc/{process}/fd")]
            if str(lock.resolve()) in opened and int(process) != os.getpid():
                os.kill(int(process), number)
        except OSError:
            continue  # it has ended, or is somebody else's
    for _ in range(50):
        if not is_locked(lock.parent):
            return
        time.sleep(0.1)


def here(arguments):
    """What the driver asks of a host: versions, unpack, serve, settle, clear."""
    what, *rest = arguments
    if what == "versions":
        print("\n".join([str(cores()), *versions(rest)]))
        return
    folder = pathlib.Path(rest[-1] if what != "serve" else rest[1])
    if what == "unpack":
        folder.mkdir(parents=True, exist_ok=True)
        with tarfile.open(fileobj=sys.stdin.buffer, mode="r|") as tar:
            tar.extractall(folder)
    elif what == "serve":
        serve(read_sweep(folder), folder, int(rest[0]), [int(i) for i in " ".join(rest[2:]).split()])
    elif what == "settle":
        settle(folder)
    elif what == "clear":
        shutil.rmtree(folder, ignore_errors=True)
