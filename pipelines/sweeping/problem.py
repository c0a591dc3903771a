# SPDX-License-Identifier: GPL-3.0-or-later
"""Exit codes of all programs of Sheet, and the error that carries one with its message to the main program."""

INTERNAL, USAGE, BAD_INPUT, CORRUPT, NOT_CONVERGED, IO = 1, 2, 3, 4, 5, 6


class Problem(Exception):
    """What is wrong, a line each, and the exit code that says so."""

    def __init__(self, exit_code, message):
        super().__init__(message)
        self.exit_code = exit_code
