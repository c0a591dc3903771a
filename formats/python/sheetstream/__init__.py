# SPDX-License-Identifier: MIT
"""Reads, writes and measures streams of thin viscous sheets with numpy (specification: formats/sheet.md).

A run is a sequence of frames, read from its file when they are asked for:

>>> from sheetstream import Run, make_frame, write
>>> square = make_frame([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], thickness=0.01)
>>> write("run.sheet", [square, square])
>>> run = Run("run.sheet")
>>> len(run), run[-1].vertices, run[-1].thickness().tolist()
(2, 4, [0.01, 0.01])
>>> run.curves()["volume"].tolist()
[0.01, 0.01]

A stage of one's own, which may stand anywhere in a pipe or in the ring of sheet-loop:

    import sheetstream
    for frame in sheetstream.stage():
        frame["velocity"] *= 0.5

`sheetstream.plot` draws with matplotlib, `import sheetstream.meshio` lets meshio read and write streams.
"""
from .quantities import QUANTITIES, Quantity
from .run import Run, make_frame, write
from .stream import (BAD_INPUT, CORRUPT, IO, PLACES, TRANSFERS, TYPES, USAGE, Array, Frame, Header, Reader, StreamError,
                     Writer, encode, find_form_error, find_value_error, read, stage, text)

__all__ = ["BAD_INPUT", "CORRUPT", "IO", "PLACES", "QUANTITIES", "TRANSFERS", "TYPES", "USAGE", "Array", "Frame",
           "Header",
           "Quantity", "Reader", "Run", "StreamError", "Writer", "encode", "find_form_error", "find_value_error",
           "make_frame", "read",
           "stage", "text", "write"]
