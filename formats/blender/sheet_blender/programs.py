# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheet's programs: where they are, and what they know of the keys of scenes and of liquids."""
from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
from typing import Any

import bpy

from .errors import SheetError


def listed(name: str, *command: str) -> list[list[str]]:
    """The rows that a program lists, by their columns: in the zip file the build has put them beside this file; else
    the program is asked."""
    beside = pathlib.Path(__file__).with_name(name)
    text = beside.read_text(encoding="utf-8") if beside.exists() else subprocess.run(
        command, capture_output=True, text=True, check=True).stdout
    return [line.split("\t") for line in text.splitlines()]


# {key of a scene: (kind, SI unit, help)}.
SCENE_KEYS = {key: (kind, unit, help_line)
              for key, kind, unit, help_line in listed("scene_keys.tsv", "sheet-init", "--list-keys")}
# sheet-render's presets: index of refraction, absorption and reduced scattering for red, green, blue [1/m].
LIQUIDS = {name: (float(index), tuple(map(float, absorption.split())), tuple(map(float, scattering.split())))
           for name, index, absorption, scattering in listed("liquids.tsv", "sheet-render", "--list-liquids")}
HOLD_KINDS = tuple(SCENE_KEYS["hold.N.kind"][0].split("|"))


def key_property(key: str, **more: Any) -> Any:
    """A number that the user gives for a key of the scene: its name, unit and help are those of the key."""
    _, unit, help_line = SCENE_KEYS[key]
    name = key.split(".")[-1].capitalize()
    return bpy.props.FloatProperty(name=f"{name} [{unit}]", description=help_line, min=1e-9, **more)


class SheetPreferences(bpy.types.AddonPreferences):
    """Where Sheet's programs are."""
    bl_idname = __package__
    programs: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Sheet's programs", subtype="DIR_PATH",
        description="The folder with sheet-run and the others; empty: where the system looks for programs")

    def draw(self, _context: Any) -> None:
        self.layout.prop(self, "programs")
        try:
            self.layout.label(text=f"found: {find_program('sheet-run')}", icon="CHECKMARK")
        except SheetError as error:
            for line in str(error).split(": ", 1):
                self.layout.label(text=line, icon="ERROR")


def program_folder() -> str:
    """The folder that the preferences name; "" if they name none, or the add-on is not enabled as one."""
    entry = bpy.context.preferences.addons.get(__package__)
    return bpy.path.abspath(entry.preferences.programs) if entry and entry.preferences else ""


def find_program(name: str) -> str:
    """The path of one of Sheet's programs. Raises SheetError."""
    folder = program_folder()
    found = shutil.which(name, path=folder) if folder else shutil.which(name)
    if found is None:
        raise SheetError(f"{name} is not in {folder or 'the folders of programs'}: install Sheet, or say in Edit >"
                         " Preferences > Add-ons > Sheet in which folder its programs are")
    return found


def environment() -> dict[str, str]:
    """That of this process, with the preferences' folder before all others: Sheet's programs call each other."""
    folder = program_folder()
    return os.environ | ({"PATH": folder + os.pathsep + os.environ.get("PATH", "")} if folder else {})
