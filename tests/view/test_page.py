#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of sheet-view in Chromium: what it says is what is in the stream, hands and keys do what they should,
hostile texts stay texts."""
import math
import os
import subprocess
import tempfile
import unittest
import urllib.parse

import numpy as np
import sheetstream
from browser import Browser

DISK = """
[sheet]
shape = "disk"
radius = 0.1
edge_length = 0.02
thickness = 0.004
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, 0, -9.81]
[[solid]]
shape = "sphere"
radius = 0.03
center = [0, 0, -0.033]
"""


def sheet(command):
    subprocess.run(["bash", "-ec", "set -o pipefail; " + command], check=True)


def frames_of(path):
    with open(path, "rb") as file:
        return list(sheetstream.Reader(file))


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        with open("disk.toml", "w") as file:
            file.write(DISK)
        sheet("sheet-init disk.toml -o first.sheet")
        sheet("sheet-loop -q -i first.sheet --until 0.1 --fps 50 -o fixed.sheet -- 'sheet-step --dt 0.01 | sheet-collide'")
        sheet("sheet-loop -q -i first.sheet --until 0.1 --fps 25 -o remeshed.sheet -- "
              "'sheet-remesh --edge-length 0.015 | sheet-step --dt 0.01'")
        sheet("sheet-view first.sheet -o first.html; sheet-view remeshed.sheet -o remeshed.html")
        sheet("sheet-view fixed.sheet remeshed.sheet -o both.html")
        cls.browser = Browser(1000, 700)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.folder.cleanup()

    def setUp(self):
        self.browser.events.clear()
        self.browser.size(1000, 700)
        self.browser.theme("light")

    def open(self, page, address=""):
        self.browser.open(page, address)
        self.browser.settle()
        self.assertEqual(self.browser.js("document.body.dataset.state"), "ready")

    def said(self, word):
        """The exact value beside a word of the panel."""
        self.browser.settle()
        return self.browser.js(f"document.querySelector('#panel dd[data-of=\"{word}\"]')?.dataset.value")

    def address(self):
        self.browser.settle()
        self.browser.until("document.body.dataset.address === 'written'")  # which it is now and then
        return dict(urllib.parse.parse_qsl(self.browser.js("location.hash.slice(1)")))

    def go(self, address):
        self.browser.js(f"location.hash = {address!r}")
        self.browser.settle()
        self.browser.settle()

    def middle(self):
        box = self.browser.js("(r => [r.x + r.width / 2, r.y + r.height / 2, Math.min(r.width, r.height)])"
                              "(document.getElementById('view').getBoundingClientRect())")
        return box

    def test_what_it_says_of_triangles_is_in_the_stream(self):
        self.open("both.html")
        for number, path in enumerate(["fixed.sheet", "remeshed.sheet"]):
            frames = frames_of(path)
            for index in (0, len(frames) // 2, len(frames) - 1):
                frame = frames[index]
                x, corners = frame["position"], frame["triangle"]
                edge = np.linalg.norm(x[corners[:, 0]] - x[corners[:, 1]], axis=1).min()
                moves = frame["velocity"] if "velocity" in frame else 0 * x
                fastest = np.linalg.norm(moves, axis=1).max()
                for triangle in np.linspace(0, len(corners) - 1, 7).astype(int):
                    self.go(f"#t={frame.time}&ask={number},{index},{triangle}")
                    self.assertEqual(self.said("triangle"), str(triangle))
                    self.assertAlmostEqual(float(self.said("thickness")) / frame.thickness()[triangle], 1, delta=6e-5)
                    place = np.array(self.said("position").split(), float)
                    self.assertLess(np.abs(place - x[corners[triangle]].mean(axis=0)).max(), 1e-3 * edge)
                    speed = np.linalg.norm(moves[corners[triangle]].mean(axis=0))
                    self.assertAlmostEqual(float(self.said("speed")), speed, delta=1e-4 * fastest + 1e-12)
        self.assertEqual(self.browser.complaints(), [])

    def test_a_triangle_is_followed_through_all_frames_of_one_mesh(self):
        self.open("both.html", "#ask=0,0,10")
        for frame in frames_of("fixed.sheet"):
            self.go(f"#t={frame.time}&ask=0,0,10")
            self.assertEqual(self.said("triangle"), "10")
            self.assertAlmostEqual(float(self.said("thickness")) / frame.thickness()[10], 1, delta=6e-5)

    def test_clicks_meet_what_is_under_them(self):
        self.open("first.html")
        self.browser.key("z")
        self.browser.key("f")
        x, y, size = self.middle()
        eye = [float(c) for c in self.address()["eye"].split(",")]
        target = np.array(eye[3:])
        height = target[2] + eye[2] - 0.002  # of the eye above the upper side, half a thickness above z = 0
        metre = size / (2 * height * math.tan(0.3))  # in pixels
        frame = frames_of("first.sheet")[0]
        for dx, dy in ((0, 0), (-60, 25), (40, -70)):
            self.browser.click(x + dx, y + dy)
            place = np.array(self.said("position").split(), float)
            # the axis x to the right or any other way about: the distance from the middle is that of the click
            self.assertAlmostEqual(np.hypot(*(place - target)[:2]), math.hypot(dx, dy) / metre, delta=2 / metre)
            a, b, c = frame["position"][frame["triangle"][int(self.said("triangle"))]][:, :2]
            signs = [np.cross(q - p, place[:2] - p) for p, q in ((a, b), (b, c), (c, a))]
            self.assertGreater(min(signs), -1e-9)
        self.browser.click(x - 480, y)
        self.assertIsNone(self.said("triangle"))
        self.browser.key("m")
        self.browser.click(x - 50, y)
        self.browser.click(x + 70, y)
        self.assertAlmostEqual(float(self.said("distance")), 120 / metre, delta=2 / metre)

    def test_a_cut_shows_its_length_and_thickness(self):
        self.open("first.html")
        self.browser.key("c")
        self.assertAlmostEqual(float(self.said("length")), 0.2, delta=0.002)
        for thickness in self.said("thickness").split():
            self.assertAlmostEqual(float(thickness), 0.004, delta=1e-6)
        self.browser.key("]")
        self.assertLess(float(self.said("length")), 0.2)
        self.browser.key("Escape")
        self.assertNotIn("cut", self.address())

    def test_keys_clock_and_address(self):
        self.open("both.html")
        self.assertEqual(int(self.browser.js("document.getElementById('time').max")), 5)  # 0, 0.02, ..., 0.1
        self.browser.key("End")
        self.assertEqual(float(self.address()["t"]), 0.1)
        labels = self.browser.js("[...document.querySelectorAll('#labels div')].map(d => d.textContent).join()")
        self.assertIn("fixed.sheet frame 5, 0.100 s", labels)
        self.assertIn("remeshed.sheet frame 3, 0.100 s", labels)
        for key in "2wo":
            self.browser.key(key)
        x, y, _ = self.middle()
        self.browser.drag(x, y, 80, 30)
        seen = self.address()
        self.assertEqual((seen["colour"], seen["mesh"], seen["solids"]), ("thickness", "1", "0"))
        self.open("both.html", self.browser.js("location.hash"))
        self.assertEqual(self.address(), seen)
        self.browser.key("t")
        self.assertEqual(self.address(), {**seen, "theme": "dark"})
        self.browser.key("Home")
        self.browser.key(" ")
        self.browser.until("location.hash.includes('t=0.1&')", 10)
        self.browser.key("?")
        self.assertTrue(self.browser.js("document.getElementById('keys').open"))
        self.assertEqual(self.browser.complaints(), [])

    def test_fingers_turn_and_pinch(self):
        self.open("first.html")
        x, y, _ = self.middle()
        def touch(kind, *places):
            points = [{"x": x + dx, "y": y + dy, "id": i} for i, (dx, dy) in enumerate(places)]
            self.browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)
        def eye():
            return [float(c) for c in self.address()["eye"].split(",")]
        before = eye()
        touch("touchStart", (0, 0))
        touch("touchMove", (60, 0))
        touch("touchEnd")
        turned = eye()
        self.assertNotAlmostEqual(turned[0], before[0], delta=0.1)
        self.assertEqual(turned[2:], before[2:])
        touch("touchStart", (-50, 0), (50, 0))
        touch("touchMove", (-100, 0), (100, 0))
        touch("touchEnd")
        self.assertAlmostEqual(eye()[2] / turned[2], 0.5, delta=0.02)
        self.assertEqual(eye()[:2], turned[:2])

    def test_an_address_that_makes_no_sense_is_passed_over(self):
        for address in ("#t=soon&eye=1,2&cut=q,1&ask=7,8,9&ends=a", "#%%%&&=&t=-1e999&eye=0,0,-1,0,0,0", "#ask=0,0,99999"):
            self.open("first.html", address)
            self.assertIsNone(self.said("triangle"))

    def test_something_is_drawn_and_colours_differ(self):
        self.open("first.html")
        def picture():
            self.browser.screenshot("picture.png")
            with open("picture.png", "rb") as file:
                return file.read()
        pictures = {picture()}
        for key in "2345w":
            self.browser.key(key)
            pictures.add(picture())
        self.browser.theme("dark")
        pictures.add(picture())
        self.assertEqual(len(pictures), 7)

    def colours_of_liquids(self):
        return self.browser.js("JSON.parse(document.getElementById('streams').textContent)[0].liquids.map(l => l.colour)")

    def test_each_liquid_has_its_look(self):
        with open("sauce.toml", "w") as file:
            for name, radius, height, viscosity in (("below", 0.1, 0, 5), ("above", 0.05, 0.02, 10)):
                file.write(f'[[sheet]]\nname = "{name}"\nshape = "disk"\nradius = {radius}\nedge_length = 0.02\n'
                           f"thickness = 0.004\ncenter = [0, 0, {height}]\n[sheet.material]\nviscosity = {viscosity}\n"
                           "density = 1000\n")
        sheet("sheet-init sauce.toml -o sauce.sheet; sheet-view sauce.sheet -o told.html; sheet-view sauce.sheet "
              "--material chocolate,honey -o look.html; sheet-view first.sheet --material honey -o honey.html")
        number = frames_of("sauce.sheet")[0]["liquid"].ravel()
        pictures = set()
        for page in ("told.html", "look.html"):
            self.open(page)
            self.assertFalse(self.browser.js("document.getElementById('legend').hidden"))
            self.browser.screenshot("picture.png")
            with open("picture.png", "rb") as file:
                pictures.add(file.read())
            for name in (0, 1):
                triangle = np.flatnonzero(number == name)[3]
                self.go(f"#ask=0,0,{triangle}")
                self.assertEqual(self.said("liquid"), ["below", "above"][name])
                self.assertEqual(self.said("sheet"), str(name))
            colours = self.colours_of_liquids()
            self.assertEqual(colours == [None, None], page == "told.html")
        self.assertEqual(len(pictures), 2)
        self.assertEqual(self.browser.js("JSON.parse(document.getElementById('quantities').textContent)"
                                         ".find(q => q.name === 'sheet').kinds.map(k => k[0]).join()"), "below,above")
        self.go("#colour=sheet")
        blue, *_, red = self.colour_in_the_middle()[::-1]
        self.assertGreater(blue, red)  # the one above is blue, the one below orange
        chocolate, honey = colours
        self.assertLess(max(chocolate), 120)
        self.assertGreater(honey[0], 180)  # amber
        self.assertLess(honey[2], 80)
        self.open("honey.html", "#ask=0,0,0")
        self.assertTrue(self.browser.js("document.getElementById('legend').hidden"))
        self.assertIsNone(self.said("liquid"))
        self.assertEqual(self.browser.complaints(), [])

    def colour_in_the_middle(self):
        """Red, green, blue of the page's picture."""
        self.browser.screenshot("picture.png")
        pixels = subprocess.run(["ffmpeg", "-v", "error", "-i", "picture.png", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                                capture_output=True, check=True).stdout
        x, y, _ = self.middle()
        at = 3 * (int(y) * 1000 + int(x))
        return np.array(list(pixels[at : at + 3]))

    def test_a_scale_of_one_value_has_it_in_its_middle(self):
        with open("thin.toml", "w") as file:
            file.write('[sheet]\nshape = "disk"\nradius = 0.1\nedge_length = 0.04\nthickness = 0.004\n[material]\n'
                       'law = "power"\nviscosity = 1e-3\nflow_index = 0.5\nrest_rate = 1\ndensity = 1000\n')
        sheet("sheet-init thin.toml -o thin.sheet; sheet-view thin.sheet -o thin.html")
        self.open("thin.html", "#colour=log_viscosity")
        red, green, blue = self.colour_in_the_middle()
        self.assertGreater(green, 0.75 * blue)  # teal, not the violet of the scale's lower end
        self.assertGreater(green, 4 * red)
        self.assertEqual(self.browser.complaints(), [])

    def test_a_narrow_window_holds_everything(self):
        self.browser.size(390, 780, mobile=True)
        self.open("both.html", "#ask=1,0,3&colour=speed&cut=x,1,0,0,0")
        self.assertLessEqual(self.browser.js("document.documentElement.scrollWidth"), 390)
        outside = self.browser.js(
            "[...document.querySelectorAll('button, select, input, #panel')].filter(e => e.offsetParent && "
            "!e.closest('dialog')).map(e => e.getBoundingClientRect()).filter(r => r.left < 0 || r.right > 390 || "
            "r.bottom > 780).length")
        self.assertEqual(outside, 0)

    def test_hostile_texts_stay_texts(self):
        bad = "</script><script>window.hacked=1</script><img src=x onerror=window.hacked=1><!--<script>"
        frame = frames_of("first.sheet")[0]
        frame["scene"] += "# " + bad + "\n"
        name = "<img src=x onerror=window.hacked=1>{{STYLE}}'\"&.sheet"
        with open(name, "wb") as file:
            writer = sheetstream.Writer(file)
            writer.write(frame)
            writer.end()
        for title in ([], ["--title", bad + "{{TITLE}}"]):
            subprocess.run(["sheet-view", name, "-o", "hostile.html", *title], check=True)
            self.open("hostile.html", "#ask=0,0,0&cut=x,1,0,0,0&t=" + urllib.parse.quote(bad))
            self.assertFalse(self.browser.js("'hacked' in window"))
            self.assertEqual(self.browser.js("document.images.length"), 0)
            self.assertEqual(self.browser.js("document.querySelector('#labels b').textContent"), name)
            self.assertIn(bad, self.browser.js("document.querySelector('#labels div').title"))
            self.assertEqual(self.browser.js("document.title"), title[1] if title else name)
            self.assertEqual(self.browser.complaints(), [])

    def test_the_page_cannot_call_out(self):
        self.open("first.html")
        self.assertEqual(self.browser.js("fetch('http://127.0.0.1:9/').then(() => 'sent', () => 'refused')"), "refused")
        self.assertTrue(any("Content Security Policy" in str(c) for c in self.browser.complaints()))

    def test_a_stream_cut_short_is_shown_as_far_as_it_goes(self):
        with open("fixed.sheet", "rb") as file:
            start = file.read()
        with open("cut.sheet", "wb") as file:
            file.write(start[:len(start) // 2])
        done = subprocess.run(["sheet-view", "cut.sheet", "-o", "cut.html"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 4)
        self.open("cut.html")
        self.assertGreater(int(self.browser.js("document.getElementById('time').max")), 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
