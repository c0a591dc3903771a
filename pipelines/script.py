# SPDX-License-Identifier: GPL-3.0-or-later
"""How a script of the pipelines takes its arguments and ends: run_script(main)."""
import inspect
import pathlib
import sys

import __main__
from sweeping.problem import BAD_INPUT, USAGE, Problem, run_main

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "formats" / "python"))
import sheetstream  # noqa: E402


def number(name, text):
    """The number that the argument of that name says. Throws Problem."""
    try:
        return float(text)
    except ValueError:
        raise Problem(USAGE, f"{name}: {text} is not a number") from None


def frames_of(path):
    """The frames of a stream, one after the other; - is standard input."""
    if path == "-":
        yield from sheetstream.read(sys.stdin.buffer, "standard input")
        return
    with open(path, "rb") as stream:
        yield from sheetstream.read(stream, path)


def run_script(main):
    """Ends the process with main(*arguments). --help prints what heads the script; what goes wrong becomes a line
    behind its name and an exit code of all programs."""
    program = f"pipelines/{pathlib.Path(sys.argv[0]).name}"
    parameters = inspect.signature(main).parameters.values()
    least = sum(p.default is p.empty for p in parameters)

    def guarded(arguments):
        if arguments[:1] in (["-h"], ["--help"]):
            print(__main__.__doc__.strip())
            return None
        if not least <= len(arguments) <= len(parameters) or "" in arguments:
            wanted = " ".join(p.name.upper() if p.default is p.empty else f"[{p.name.upper()}]" for p in parameters)
            raise Problem(USAGE, f"usage: {program} {wanted} (see --help)".replace("  ", " "))
        try:
            return main(*arguments)
        except sheetstream.StreamError as error:
            raise Problem(error.exit_code, str(error)) from None
        except (KeyError, IndexError) as error:
            raise Problem(BAD_INPUT, f"what is given does not have {error}") from None

    run_main(program, guarded)
