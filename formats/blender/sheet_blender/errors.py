# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong, for the user."""


class SheetError(Exception):
    """What is wrong with a file or an object, for the user."""
