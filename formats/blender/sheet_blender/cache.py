# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a run: what is in it, whether sheet-run is at work there, and whether it is that of the settings.

    scene.toml, ...          what was written for sheet-run
    settings.json            what the panels said then, as a checksum
    process.json             which process is at work
    log.txt                  what it said
    run/                     what sheet-run leaves: run.sheet, progress.json, health.txt, ...
    run~/                    the run before it
"""
from __future__ import annotations

import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
from typing import Any, NamedTuple

import bpy
import numpy as np

from .compat import fcurves_of
from .errors import SheetError
from .parts import plan_of, sheets_of, things_with
from .programs import environment, find_program

SCENE, RUN, PROGRESS = "scene.toml", "run/run.sheet", "run/progress.json"
PATIENCE = 20  # [s] until a run that was asked to stop must have


class Progress(NamedTuple):
    """state: none, starting, running, ending (figures are made of the run), stopped, done, failed; part: 0 to 1 of it;
    left [s], or None."""
    state: str
    part: float = 0.0
    left: float | None = None
    frames: int = 0
    message: str = ""

    @property
    def alive(self) -> bool:
        return self.state in ("starting", "running", "ending")


def folder_of(scene: bpy.types.Scene) -> pathlib.Path:
    """Where the run of the scene's sheets is; beside the .blend it has the name of the first one, or of that for which
    there is a folder, and that of the scene if another one has the sheet, too. Raises SheetError if there is no place
    for it yet."""
    names = [_as_file(thing.name) for thing in sheets_of(scene)]
    if scene.sheet_run.cache:
        chosen = pathlib.Path(bpy.path.abspath(scene.sheet_run.cache))
        if _is_of_another(chosen, scene):
            raise SheetError(f'{chosen} has the run of the scene "{noted(chosen)["scene"]}": choose another folder,'
                             " Sheet Run > Cache")
        return chosen
    if not bpy.data.filepath:
        raise SheetError("save the .blend first: the run is kept beside it (or choose a folder, Sheet Run > Cache)")
    blend = pathlib.Path(bpy.data.filepath)
    folders = [blend.with_name(f"{blend.stem}_sheet") / each
               for name in names for each in (name, f"{name}_{_as_file(scene.name)}")]
    free = [folder for folder in folders if not _is_of_another(folder, scene)]
    return next((folder for folder in free if folder.exists()), (free or folders)[0])


def _as_file(name: str) -> str:
    return re.sub(r"[^\w.-]+", "_", name)


def _is_of_another(folder: pathlib.Path, scene: bpy.types.Scene) -> bool:
    """Whether a folder has the run of another scene of this file."""
    name = noted(folder).get("scene", scene.name)
    return name != scene.name and name in bpy.data.scenes


# ---- the process


def _started(pid: int) -> str | None:
    """When a process began, as Linux counts; None if there is none. A number alone may be another's by now."""
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
    return None if fields[0] == "Z" else fields[19]


_children: dict[int, subprocess.Popen[bytes]] = {}  # those of this Blender, which leave a zombie until they are asked


def process_of(folder: pathlib.Path) -> int | None:
    """The sheet-run that works in the folder, also one that another Blender has started."""
    try:
        said = json.loads((folder / "process.json").read_text())
        pid, begun = int(said["pid"]), str(said["begun"])
    except (OSError, ValueError, KeyError):
        return None
    if pid in _children and _children[pid].poll() is not None:
        del _children[pid]
        return None
    return pid if _started(pid) == begun else None


def start(folder: pathlib.Path, rate: float, until: float, quality: str) -> None:
    """Starts sheet-run on the folder's scene, or goes on with its run. Raises SheetError."""
    if process_of(folder) is not None:
        raise SheetError("the run goes on already: stop it first")
    command = [find_program("sheet-run"), SCENE, "-o", "run", "--until", repr(until), "--fps", repr(rate), "--quality",
               quality, "--stream-only"]
    (folder / PROGRESS).unlink(missing_ok=True)
    with open(folder / "log.txt", "wb") as log:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                   env=environment(), start_new_session=True)
    _children[process.pid] = process
    (folder / "process.json").write_text(json.dumps({"pid": process.pid, "begun": _started(process.pid)}))


def stop(folder: pathlib.Path) -> bool:
    """Interrupts the run in good order and waits for its end; False if none goes on."""
    pid = process_of(folder)
    if pid is None:
        return False
    os.killpg(pid, signal.SIGINT)
    deadline = time.monotonic() + PATIENCE
    while process_of(folder) is not None:
        if time.monotonic() > deadline:
            os.killpg(pid, signal.SIGTERM)
            deadline += PATIENCE
        time.sleep(0.05)
    return True


# ---- what is there


def _read_progress(folder: pathlib.Path) -> dict[str, Any]:
    try:
        return dict(json.loads((folder / PROGRESS).read_text()))
    except (OSError, ValueError):
        return {}


def last_words(folder: pathlib.Path) -> str:
    """What sheet-run said last of what is wrong, without the names of programs."""
    try:
        lines = (folder / "log.txt").read_text(errors="replace").splitlines()
    except OSError:
        return ""
    said = [line for line in lines if re.match(r"sheet-\w+: ", line)]
    last = next((line for line in reversed(said) if not line.startswith("sheet-run: ")), said[-1] if said else "")
    return re.sub(r"^sheet-\w+: (error: )?", "", last)


def progress_of(folder: pathlib.Path) -> Progress:
    """How far the folder's run is."""
    said = _read_progress(folder)
    alive = process_of(folder) is not None
    if not said:
        if alive:
            return Progress("starting", message="checks the scene")
        if not (folder / RUN).exists():
            failed = (folder / "log.txt").exists() and (folder / "process.json").exists()
            return Progress("failed", message=last_words(folder)) if failed else Progress("none")
        return Progress("stopped" if not (folder / "process.json").exists() else "failed", message=last_words(folder))
    part = min(1.0, said["time"] / said["until"]) if said.get("until") else 0.0
    state = {"done": "ending" if alive else "done", "interrupted": "ending" if alive else "stopped",
             "running": "running" if alive else "failed"}[said["state"]]
    message = {"running": f"t = {said['time']:.3g} of {said['until'] or 0:.3g} s", "failed": last_words(folder)}
    return Progress(state, part, said["left"] if state == "running" else None, int(said["frames"]),
                    message.get(state, ""))


def put_aside(folder: pathlib.Path) -> None:
    """Makes room for another run: the one that is there becomes run~ in place of an earlier one."""
    if (folder / RUN).exists():
        shutil.rmtree(folder / "run~", ignore_errors=True)
        (folder / "run").rename(folder / "run~")
    shutil.rmtree(folder / "run", ignore_errors=True)
    for pattern in ("scene.*", "scene_*", "settings.json", "process.json", "log.txt"):
        for file in folder.glob(pattern):
            file.unlink()


def free(folder: pathlib.Path) -> None:
    """Removes what the add-on and sheet-run have put there, and the folder if nothing else is in it."""
    stop(folder)
    put_aside(folder)
    shutil.rmtree(folder / "run~", ignore_errors=True)
    if folder.exists() and not any(folder.iterdir()):
        folder.rmdir()


# ---- whether it is that of the settings


def checksum_of_files(files: list[str]) -> str:
    """Of what sheet-run reads."""
    digest = hashlib.sha256()
    for file in sorted(files):
        if not file.endswith(".npz"):  # follows from the others, and has the time of its making in it
            digest.update(pathlib.Path(file).name.encode() + b"\0" + pathlib.Path(file).read_bytes())
    return digest.hexdigest()


def _numbers(data: Any, name: str, width: int, kind: Any) -> bytes:
    values = np.empty(width * len(data), kind)
    data.foreach_get(name, values)
    return values.tobytes()


def _said_of(thing: bpy.types.Object) -> bytes:
    """What a run depends on of an object, without evaluating it."""
    words = [thing.name, thing.type, thing.sheet_part.contact, str([group.name for group in thing.vertex_groups])]
    curves = [curve for owner in (thing, thing.data) for curve in fcurves_of(owner)]
    words += [f"{c.data_path}{c.array_index}{[tuple(k.co) for k in c.keyframe_points]}" for c in curves]
    if not fcurves_of(thing):
        words.append(str([round(x, 6) for row in thing.matrix_world for x in row]))
    words += [repr([(p.identifier, str(getattr(m, p.identifier))) for p in m.bl_rna.properties
                    if p.type in ("BOOLEAN", "INT", "FLOAT", "ENUM") and not p.identifier.startswith("show_")
                    and p.identifier not in ("is_active", "execution_time") and not getattr(p, "is_array", False)])
              for m in thing.modifiers]
    said = "\n".join(words).encode()
    if thing.type == "MESH":
        mesh = thing.data
        said += _numbers(mesh.vertices, "co", 3, np.float32) + _numbers(mesh.loops, "vertex_index", 1, np.int32)
    return said


def checksum_of_settings(scene: bpy.types.Scene) -> str:
    """Of what the panels and the objects say, quickly: for a panel to tell that a run is older. (Weights that are
    painted anew are seen when a run is gone on with.) Raises SheetError."""
    plan = plan_of(scene)
    words = [repr(value) for said in (plan, *plan.sheets) for name, value in vars(said).items()
             if name not in ("thing", "sheets", "solids")]
    words += [scene.sheet_run.quality, repr(scene.render.fps / scene.render.fps_base), str(scene.frame_start),
              str(list(scene.gravity)), str(scene.use_gravity), repr(scene.unit_settings.scale_length)]
    digest = hashlib.sha256("\n".join(words).encode())
    for thing in (*(sheet.thing for sheet in plan.sheets), *things_with("SOLID", scene)):
        digest.update(_said_of(thing))
    return digest.hexdigest()


def note_settings(folder: pathlib.Path, scene: bpy.types.Scene, files: list[str]) -> None:
    said = {"settings": checksum_of_settings(scene), "files": checksum_of_files(files),
            "scene": scene.name, "sheets": [thing.name for thing in sheets_of(scene)]}
    (folder / "settings.json").write_text(json.dumps(said))


def noted(folder: pathlib.Path) -> dict[str, Any]:
    try:
        return dict(json.loads((folder / "settings.json").read_text()))
    except (OSError, ValueError):
        return {}


def sheets_noted(folder: pathlib.Path) -> list[str]:
    """The names of the objects that the run's sheets are, in its order; empty if nobody has noted them."""
    return [str(name) for name in noted(folder).get("sheets", [])]


_older: dict[str, tuple[float, bool]] = {}


def is_older(folder: pathlib.Path, scene: bpy.types.Scene) -> bool:
    """Whether the folder's run is of other settings than the panels have now; asked anew at most twice a second."""
    now = time.monotonic()
    known = _older.get(str(folder))
    if known is None or now - known[0] > 0.5:
        try:
            older = bool(noted(folder)) and noted(folder)["settings"] != checksum_of_settings(scene)
        except SheetError:
            older = True
        known = _older[str(folder)] = (now, older)
    return known[1]
