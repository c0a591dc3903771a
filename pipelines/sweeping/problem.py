# SPDX-License-Identifier: GPL-3.0-or-later
"""Exit codes of all programs of Sheet, the error that carries one with its message to the main program, and how a
main program ends."""
import os
import sys

INTERNAL, USAGE, BAD_INPUT, CORRUPT, NOT_CONVERGED, IO = 1, 2, 3, 4, 5, 6


class Problem(Exception):
    """What is wrong, a line each, and the exit code that says so."""

    def __init__(self, exit_code, message):
        super().__init__(message)
        self.exit_code = exit_code


def run_main(program, main):
    """Ends the process with what main(arguments) returns; what goes wrong becomes lines behind the program's name, and
    an exit code."""
    try:
        sys.exit(main(sys.argv[1:]))
    except Problem as problem:
        code, told = problem.exit_code, str(problem)
    except KeyboardInterrupt:
        code, told = 130, "interrupted; the same command goes on"
    except BrokenPipeError:  # nobody wants to read more
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return
    except OSError as error:  # a folder that cannot be written, a full disk
        code, told = IO, f"{error.filename}: {error.strerror}" if error.filename else str(error)
    for line in told.splitlines():
        print(f"{program}: {line}", file=sys.stderr)
    sys.exit(code)
