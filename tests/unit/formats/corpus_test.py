#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The numpy module against the corpus; the C++ reader and writer do the same in stream_corpus.cpp, so both agree."""
import filecmp
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(root / "formats/python"))
import sheetstream  # noqa: E402

import numpy as np  # noqa: E402

corpus = root / "formats/corpus/1.0"
stage = root / "formats/python/example_stage.py"


def encode(frames):
    file = io.BytesIO()
    writer = sheetstream.Writer(file)
    for frame in frames:
        writer.write(frame)
    writer.end()
    return file.getvalue()


def run_stage(data, *options):
    return subprocess.run([stage, *options], input=data, capture_output=True, check=False)


class Corpus(unittest.TestCase):
    def files(self, kind):
        paths = sorted((corpus / kind).glob("*.sheet"))
        self.assertGreaterEqual(len(paths), 15)
        for path in paths:
            with self.subTest(path.name):
                yield path, path.read_bytes(), path.with_suffix(".txt").read_bytes().decode()

    def test_passed(self):
        for path, data, twin in self.files("passed"):
            reader = sheetstream.Reader(io.BytesIO(data))
            text, ends, frames = "sheet-text 1.0\n", 0, []
            for frame in reader:
                text += "end\n" * (reader.ends - ends) + sheetstream.text(frame)
                ends = reader.ends
                frames.append(frame)
            self.assertEqual(text + "end\n" * (reader.ends - ends), twin)
            if reader.ends == 1 and "newer_minor" not in path.name:
                self.assertEqual(encode(frames), data)
                self.assertEqual(run_stage(data, "--no-provenance").stdout, data)

    def test_failed(self):
        for _, data, twin in self.files("failed"):
            with self.assertRaises(sheetstream.StreamError) as caught:
                list(sheetstream.read(io.BytesIO(data), "file"))
            self.assertEqual(f"{caught.exception}\nexit code {caught.exception.exit_code}\n", f"file: {twin}")

    def test_is_made_anew_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([root / "formats/corpus/make.py", folder], check=True)
            for kind in ("passed", "failed"):
                same = filecmp.dircmp(corpus / kind, pathlib.Path(folder, "1.0", kind))
                self.assertEqual((same.left_only, same.right_only), ([], []))
                self.assertEqual(filecmp.cmpfiles(same.left, same.right, same.common, shallow=False)[1:], ([], []))


class Module(unittest.TestCase):
    def setUp(self):
        self.data = (corpus / "passed/0003_one_triangle.sheet").read_bytes()
        self.frame, = sheetstream.read(io.BytesIO(self.data))

    def test_every_prefix_and_every_changed_byte_is_refused(self):
        changed = (self.data[:i] + bytes([b ^ 1 << i % 8]) + self.data[i + 1:] for i, b in enumerate(self.data))
        for data in (*(self.data[:i] for i in range(len(self.data))), *changed):
            with self.assertRaises(sheetstream.StreamError) as caught:
                list(sheetstream.read(io.BytesIO(data)))
            self.assertEqual(caught.exception.exit_code, 4)
            self.assertRegex(str(caught.exception), r"stream: frame [01], byte \d+: ")

    def test_area_and_thickness(self):
        self.assertEqual(self.frame.area().tolist(), [0.25])
        self.assertEqual(self.frame.thickness().tolist(), [0.004])

    def test_counts_follow_the_arrays(self):
        self.frame["position"] = np.zeros((5, 3))
        self.assertEqual((self.frame.vertices, self.frame.triangles, self.frame.edges), (5, 1, 0))

    def test_provenance_is_counted(self):
        for command in ("a (1) -x", "b (1)", "a (1) -x", "a (1)", "b (1)"):
            self.frame.record(command)
        self.assertEqual(self.frame["provenance"], "2 a (1) -x\n2 b (1)\n1 a (1)")
        self.frame["provenance"] = "\nx b (1)\n"
        self.frame.record("b (1)")
        self.assertEqual(self.frame["provenance"], "1 b (1)")

    def test_bad_frames_are_not_written(self):
        self.frame.arrays["Bad"] = sheetstream.Array(np.zeros(3))
        with self.assertRaisesRegex(sheetstream.StreamError, 'cannot write frame: array "Bad": its name is not'):
            encode([self.frame])
        del self.frame.arrays["Bad"]
        self.frame.arrays["bad"] = sheetstream.Array(np.zeros(4))
        with self.assertRaisesRegex(sheetstream.StreamError, "it has 4 rows, the frame has 3 at place vertex"):
            encode([self.frame])


class Stage(unittest.TestCase):
    data = (corpus / "passed/0005_standard_arrays.sheet").read_bytes()

    def test_effect_and_provenance(self):
        frame, = sheetstream.read(io.BytesIO(run_stage(self.data, "--wind", "0.5").stdout))
        self.assertEqual(frame["velocity"][:, 0].tolist(), [0.25] * 3)
        self.assertTrue(frame["provenance"].endswith("\n1 example_stage.py (1.0) --wind 0.5"))

    def test_exit_codes(self):
        for data, options, code, message in (
                (self.data[:-1], (), 4, "standard input: frame 1, byte 2303: the end mark is cut short"),
                (b"", (), 4, "standard input: frame 0, byte 0: the stream is empty: not even an end mark"),
                (self.data, ("--wind", "inf"), 3, 'frame 0 would be wrong: array "velocity": row 0 is not finite')):
            result = run_stage(data, *options)
            self.assertEqual((result.returncode, result.stderr.decode()), (code, f"example_stage.py: {message}\n"))
        self.assertEqual(run_stage(self.data, "--storm").returncode, 2)
        with open("/dev/full", "wb") as full:
            result = subprocess.run([stage], input=self.data, stdout=full, stderr=subprocess.PIPE, check=False)
        self.assertEqual(result.returncode, 6)

    def test_closed_pipe_is_quiet(self):
        many = self.data[:-64] * 1000
        shell = f"{stage} | head -c 1 >/dev/null; echo ${{PIPESTATUS[0]}}"
        result = subprocess.run(["bash", "-c", shell], input=many, capture_output=True, check=False)
        self.assertEqual((result.stdout, result.stderr), (b"0\n", b""))


if __name__ == "__main__":
    unittest.main()
