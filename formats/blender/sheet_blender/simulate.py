# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulate, resume, stop and free: sheet-run at work beside Blender, whose frames are shown as they come."""
from __future__ import annotations

import pathlib
import tempfile
import time
from typing import Any

import bpy
from bpy.app.handlers import persistent
from mathutils import Matrix

from . import cache
from .compat import confirm
from .errors import SheetError
from .follow import forget, open_run, update_object
from .looks import set_materials
from .parts import liquid_of, plan_of, sheets_of, times_of
from .plan import Written
from .scene_file import write_scene
from .sheet_tables import mesh_file_of
from .slab import add_slab

INTERVAL = 0.2  # [s] between looks at a run

_watched: set[str] = set()  # folders that a modal operator looks at


def write_here(folder: pathlib.Path, scene: bpy.types.Scene) -> Written:
    """Writes what the panels say, at the scene's first frame. Raises SheetError, OSError."""
    folder.mkdir(parents=True, exist_ok=True)
    plan, now = plan_of(scene), scene.frame_current
    hidden = [thing for thing in (*(sheet.thing for sheet in plan.sheets), *(solid for solid, _ in plan.solids))
              if thing.hide_viewport]
    try:
        for thing in hidden:
            thing.hide_viewport = False  # what is disabled in viewports is not evaluated
        scene.frame_set(scene.frame_start)
        return write_scene(str(folder / cache.SCENE), plan)
    finally:
        for thing in hidden:
            thing.hide_viewport = True
        scene.frame_set(now)


def begin(scene: bpy.types.Scene) -> list[str]:
    """Writes the scene anew and starts its run; returns what is told. Raises SheetError, OSError."""
    folder = cache.folder_of(scene)
    rate, until = times_of(scene)
    if cache.process_of(folder) is not None:
        raise SheetError("the run goes on already: stop it first")
    cache.put_aside(folder)
    forget(str(folder / cache.RUN))
    written = write_here(folder, scene)
    cache.note_settings(folder, scene, written.files)
    cache.start(folder, rate, until, scene.sheet_run.quality)
    return written.told


def go_on(scene: bpy.types.Scene) -> list[str]:
    """Goes on with the run that is there, to the scene's last frame. Raises SheetError, OSError."""
    folder = cache.folder_of(scene)
    rate, until = times_of(scene)
    if not (folder / cache.RUN).exists():
        raise SheetError("there is no run to go on with: Simulate begins one")
    with tempfile.TemporaryDirectory() as other:
        written = write_here(pathlib.Path(other), scene)
        if cache.checksum_of_files(written.files) != cache.noted(folder).get("files"):
            raise SheetError("the run is of other settings than those of now, and cannot go on with them: set them"
                             " back, or choose Simulate, which begins anew")
    cache.start(folder, rate, until, scene.sheet_run.quality)
    return written.told


# ---- what is shown


def results_of(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """The objects that show the run of the scene's sheets, one for each, made when the run has a frame: in the sheet's
    collections, with its name and its materials, or those of its liquid; the sheets themselves are hidden. None as long
    as there is no frame."""
    folder = cache.folder_of(scene)
    file = folder / cache.RUN
    try:
        run = open_run(str(file)) if file.exists() else None
    except SheetError:  # it is just being made
        run = None
    if run is None:
        return []
    return [_result_of(scene.objects[name], number, folder, scene) for number, name in _numbered_sheets(folder, scene)]


def _numbered_sheets(folder: pathlib.Path, scene: bpy.types.Scene) -> list[tuple[int, str]]:
    """The objects that are a run's sheets, by number and name; -1 for the only one."""
    names = cache.sheets_noted(folder) or [thing.name for thing in sheets_of(scene)]
    return [(number if len(names) > 1 else -1, name) for number, name in enumerate(names) if name in scene.objects]


def _results_there(folder: pathlib.Path,
                   scene: bpy.types.Scene) -> list[tuple[bpy.types.Object, bpy.types.Object]]:
    """The sheets of a run and what shows them, where that is."""
    shown = [(scene.objects[name], _shown_for(scene.objects[name], number, folder, scene))
             for number, name in _numbered_sheets(folder, scene)]
    return [(thing, each) for thing, each in shown if each is not None]


def _result_of(thing: bpy.types.Object, number: int, folder: pathlib.Path,
               scene: bpy.types.Scene) -> bpy.types.Object:
    shown = _shown_for(thing, number, folder, scene)
    if shown is None:
        shown = _make_result(thing, scene)
        thing.sheet_part.result = shown
    mesh_file = mesh_file_of(folder / cache.SCENE, max(number, 0), number >= 0)
    wanted = {"first_time": 0.0, "mesh_file": str(mesh_file), "start": scene.frame_start, "number": number,
              "file": str(folder / cache.RUN)}
    for name, value in wanted.items():
        if getattr(shown.sheet, name) != value:  # each change shows the run anew
            setattr(shown.sheet, name, value)
    return shown


def _shown_for(thing: bpy.types.Object, number: int, folder: pathlib.Path,
               scene: bpy.types.Scene) -> bpy.types.Object | None:
    """What shows a sheet in this scene: the object knows what was made last, maybe in another scene."""
    shown = thing.sheet_part.result
    if shown is not None and shown.name in scene.objects:
        return shown
    return next((each for each in scene.objects if each.sheet.file == str(folder / cache.RUN) and
                 each.sheet.number == number and each.name.startswith(thing.name)), None)


def _make_result(thing: bpy.types.Object, scene: bpy.types.Scene) -> bpy.types.Object:
    name = f"{thing.name} sheet"
    shown = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    here = [c for c in (scene.collection, *scene.collection.children_recursive) if thing.name in c.objects]
    for collection in here or [scene.collection]:
        collection.objects.link(shown)
    shown.matrix_world = Matrix.Scale(1 / scene.unit_settings.scale_length, 4)
    add_slab(shown)
    materials = [slot.material for slot in thing.material_slots]
    if any(materials):
        for material in materials:
            shown.data.materials.append(material)
    else:
        set_materials(shown, liquid_of(thing, scene).look, scene)
    _set_hidden(thing, True)
    return shown


def _set_hidden(thing: bpy.types.Object, hidden: bool) -> None:
    thing.hide_render = hidden
    try:
        thing.hide_set(hidden)
    except RuntimeError:  # it is not in this view layer
        pass


def show_newest(scene: bpy.types.Scene) -> int:
    """Shows what there is of the run; the scene goes to its newest frame if it shall. Returns the number of frames."""
    shown = results_of(scene)
    if not shown:
        return 0
    run = open_run(shown[0].sheet.file)
    newest = scene.frame_start + len(run) - 1
    if scene.sheet_run.follow and scene.frame_current != newest:
        scene.frame_set(newest)
    else:
        for thing in shown:
            update_object(thing, scene)
    return len(run)


# ---- operators


def duration(seconds: float) -> str:
    whole = round(seconds)
    return f"{whole} s" if whole < 60 else f"{whole // 60}:{whole % 60:02} min" if whole < 3600 else \
        f"{whole // 3600}:{whole % 3600 // 60:02} h"


def words_of(progress: cache.Progress) -> str:
    """A line for people."""
    if progress.state == "starting":
        return "Sheet checks the scene"
    if progress.state == "running":
        left = "" if progress.left is None else f", {duration(progress.left)} left"
        return f"Sheet: {100 * progress.part:.0f} %, {progress.frames} frames, {progress.message}{left}"
    return {"ending": "Sheet ends the run", "stopped": f"Stopped with {progress.frames} frames",
            "done": f"Done, {progress.frames} frames", "failed": f"Failed: {progress.message}", "none": "No run yet"
            }[progress.state]


class _Watching:
    """What simulate and resume have in common: in a window they look at the run as long as it goes on, and Escape stops
    it; a script waits for its end, unless wait is False."""
    wait: bpy.props.BoolProperty(name="Wait", default=True, options={"SKIP_SAVE"})  # type: ignore[valid-type]

    def watch(self, context: Any) -> set[str]:
        self.folder = cache.folder_of(context.scene)
        self.scene_name, self.seen = context.scene.name, -1
        _watched.add(str(self.folder))
        self.timer = context.window_manager.event_timer_add(INTERVAL, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        scene = bpy.data.scenes.get(self.scene_name)
        if scene is None:
            return self.leave(context)
        if event.type == "ESC" and event.value == "PRESS":
            cache.stop(self.folder)
        elif event.type != "TIMER":
            return {"PASS_THROUGH"}
        progress = cache.progress_of(self.folder)
        context.workspace.status_text_set(words_of(progress) + "    Esc: stop")
        size = _size_of(self.folder / cache.RUN)
        if size != self.seen:
            self.seen = size
            try:
                show_newest(scene)
            except SheetError as error:
                print(f"Sheet: {error}")
        _redraw(context)
        if progress.alive:
            return {"PASS_THROUGH"}
        if progress.state == "failed":
            self.report({"ERROR"}, words_of(progress))
        else:
            self.report({"INFO"}, f"Sheet: {words_of(progress)}")
        return self.leave(context)

    def leave(self, context: Any) -> set[str]:
        _watched.discard(str(self.folder))
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)
        _redraw(context)
        return {"FINISHED"}

    def cancel(self, context: Any) -> None:
        """Blender closes the file or itself: the run goes on, and is found again."""
        self.leave(context)

    def follow_to_end(self, context: Any) -> set[str]:
        """Of scripts."""
        folder = cache.folder_of(context.scene)
        while self.wait and cache.progress_of(folder).alive:
            time.sleep(INTERVAL)
        show_newest(context.scene)
        progress = cache.progress_of(folder)
        if progress.state == "failed":
            self.report({"ERROR"}, words_of(progress))
            return {"CANCELLED"}
        return {"FINISHED"}

    def started(self, context: Any, begin_run: Any) -> bool:
        """Begins, and tells what is wrong or left out."""
        try:
            told = begin_run(context.scene)
        except (SheetError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return False
        for line in told:
            self.report({"WARNING"}, line)
        return True


def _size_of(file: pathlib.Path) -> int:
    try:
        return file.stat().st_size
    except OSError:
        return -1


def _redraw(context: Any) -> None:
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in ("PROPERTIES", "VIEW_3D", "DOPESHEET_EDITOR"):
                area.tag_redraw()


class SHEET_OT_simulate(_Watching, bpy.types.Operator):
    """Simulate the sheets from the scene's first frame to its last; a run that is there is kept as run~, once"""
    bl_idname = "sheet.simulate"
    bl_label = "Simulate"

    def invoke(self, context: Any, _event: Any) -> set[str]:
        return self.watch(context) if self.started(context, begin) else {"CANCELLED"}

    def execute(self, context: Any) -> set[str]:
        return self.follow_to_end(context) if self.started(context, begin) else {"CANCELLED"}


class SHEET_OT_resume(_Watching, bpy.types.Operator):
    """Go on with the run where it was stopped, or to a later last frame"""
    bl_idname = "sheet.resume"
    bl_label = "Resume"

    def invoke(self, context: Any, _event: Any) -> set[str]:
        return self.watch(context) if self.started(context, go_on) else {"CANCELLED"}

    def execute(self, context: Any) -> set[str]:
        return self.follow_to_end(context) if self.started(context, go_on) else {"CANCELLED"}


class SHEET_OT_watch(_Watching, bpy.types.Operator):
    """Look at a run that goes on, such as one that an earlier Blender has started"""
    bl_idname = "sheet.watch"
    bl_label = "Watch the Run"
    bl_options = {"INTERNAL"}

    def invoke(self, context: Any, _event: Any) -> set[str]:
        return self.watch(context)


class SHEET_OT_stop(bpy.types.Operator):
    """Stop the run at its newest frame; Resume goes on from there"""
    bl_idname = "sheet.stop"
    bl_label = "Stop"

    def execute(self, context: Any) -> set[str]:
        try:
            stopped = cache.stop(cache.folder_of(context.scene))
            show_newest(context.scene)
        except (SheetError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if not stopped:
            self.report({"INFO"}, "no run goes on")
        return {"FINISHED"}


class SHEET_OT_free(bpy.types.Operator):
    """Remove the run from the disk, and show the sheets themselves again"""
    bl_idname = "sheet.free"
    bl_label = "Free the Run"

    def invoke(self, context: Any, event: Any) -> set[str]:
        return confirm(self, event, "The run is removed from the disk.")

    def execute(self, context: Any) -> set[str]:
        try:
            folder = cache.folder_of(context.scene)
            results = _results_there(folder, context.scene)
            cache.free(folder)
        except (SheetError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        forget(str(folder / cache.RUN))
        for thing, shown in results:
            bpy.data.objects.remove(shown)
            _set_hidden(thing, False)
        return {"FINISHED"}


# ---- runs of an earlier Blender


def _find_again() -> None:
    """A timer, once after a file is open: watches its run if that goes on, and shows what has come in the meantime of
    one that has ended."""
    window = bpy.context.window_manager.windows[0] if bpy.context.window_manager.windows else None
    for scene in bpy.data.scenes:
        try:
            folder = cache.folder_of(scene)
        except SheetError:
            continue
        if cache.process_of(folder) is not None and window is not None and str(folder) not in _watched:
            with bpy.context.temp_override(window=window, scene=scene):
                bpy.ops.sheet.watch("INVOKE_DEFAULT")
        else:
            results_of(scene)


@persistent
def on_load(*_: Any) -> None:
    _watched.clear()
    if not bpy.app.background:
        bpy.app.timers.register(_find_again, first_interval=0.5, persistent=True)


CLASSES = (SHEET_OT_simulate, SHEET_OT_resume, SHEET_OT_watch, SHEET_OT_stop, SHEET_OT_free)
