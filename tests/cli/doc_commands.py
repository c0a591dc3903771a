#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the commands of a page (Markdown) as a shell script, shortened: what stands indented and begins with sheet-.

    tests/cli/doc_commands.py PAGE
"""
import re
import sys

lines = open(sys.argv[1], encoding="utf-8").read().split("\n")
script = []
i = 0
while i < len(lines):
    line = lines[i]
    i += 1
    if not re.match(r"    sheet-[a-z]+ (?!\d)", line):
        continue
    command = line[4:]
    while re.search(r"(\\|\|)\s*$", command):
        command += "\n" + lines[i][4:]
        i += 1
    here = re.search(r"<< '(\w+)'", command)
    while here:
        command += "\n" + lines[i][4:]
        i += 1
        if lines[i - 1][4:] == here.group(1):
            break
    script.append(command)

for command in script:
    changed = "--resume" in command and "--set" in command  # refused if there is nothing left to run
    command = re.sub(r"--until [0-9.]+", "--until 0.03" if changed else "--until 0.02", command)
    command = re.sub(r"--steps [0-9]+", "--steps 2", command)
    command = re.sub(r"^sheet-run ", "sheet-run --film 64x36 ", command)
    print(command.replace("your-stage", "sheet-pass"))
