#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""sheet-watch: frames pass unchanged and unhindered, the page says what sheet-info says, nothing can be changed through it,
and a browser shows it."""
import csv
import json
import os
import pathlib
import re
import socket
import subprocess
import tempfile
import time
import unittest
import urllib.error
import urllib.request

import numpy as np
import sheetstream
from browser import Browser


class Watch:
    """A sheet-watch that is given frames one by one."""

    def __init__(self, *options):
        self.passed = open("passed.sheet", "wb")  # which is locked until it is closed
        self.process = subprocess.Popen(["sheet-watch", "--port", "0", *options], stdin=subprocess.PIPE,
                                        stdout=self.passed, stderr=subprocess.PIPE)
        said = self.process.stderr.readline().decode()
        self.url = re.search(r"http://[\d.]+:\d+/", said)[0]
        self.writer = sheetstream.Writer(self.process.stdin)

    def give(self, frame):
        self.writer.write(frame)
        self.process.stdin.flush()

    def state(self):
        return json.loads(self.get("state.json")[1])

    def state_at(self, step):
        """The state when the step has been measured."""
        for _ in range(200):
            state = self.state()
            if state.get("step") == step:
                return state
            time.sleep(0.02)
        raise AssertionError(f"step {step} does not come: {state}")

    def get(self, path, **headers):
        request = urllib.request.Request(self.url + path, headers=headers)
        try:
            with urllib.request.urlopen(request, timeout=10) as answer:
                return answer.status, answer.read().decode()
        except urllib.error.HTTPError as error:
            return error.code, error.read().decode()

    def end(self):
        self.writer.end()
        self.process.stdin.close()
        self.process.stderr.close()
        self.passed.close()
        return self.process.wait(timeout=20)

    def give_up(self):
        if self.process.returncode is None:
            self.process.kill()
            self.process.wait()
            self.passed.close()


class Test(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        subprocess.run(["bash", "-ec", "sheet-init --example | sed -e 's/^edge_length = .*/edge_length = 0.1/' "
                        "-e '0,/^#surface_tension = /s/^#surface_tension = .*/surface_tension = 0.04/' > scene.toml; "
                        "sheet-init scene.toml | sheet-loop -q --until 0.2 --keep 1 -o run.sheet -- 'sheet-step | sheet-collide';"
                        "sheet-info --csv run.sheet > run.csv"], check=True)
        with open("run.csv") as file:
            cls.rows = [{k: float(v) for k, v in row.items() if v} for row in csv.DictReader(file)]
        cls.run_of = sheetstream.Run("run.sheet")

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.folder.cleanup()

    def setUp(self):
        self.watches = []
        self.addCleanup(lambda: [watch.give_up() for watch in self.watches])

    def watch(self, *options):
        self.watches.append(Watch(*options))
        return self.watches[-1]

    def test_curves_are_what_sheet_info_says_and_frames_pass_unchanged(self):
        watch = self.watch("--until", "0.4")
        self.assertNotIn("step", watch.state())
        self.assertEqual(watch.get("frame.html")[0], 503)
        for row, frame in zip(self.rows, self.run_of):
            watch.give(frame)
            state = watch.state_at(row["step"])
            self.assertEqual((state["time"], state["vertices"], state["triangles"]),
                             (row["time"], row["vertices"], row["triangles"]))
        for name in ("time", "volume", "area", "thickness_min", "thickness_mean", "thickness_max", "kinetic_energy"):
            self.assertEqual(state["curves"][name], [row[name] for row in self.rows], name)
        scene = self.run_of[0].scene()
        for i, frame in enumerate(self.run_of):
            weight = scene["material"]["density"] * frame["volume"][:, None] * frame["position"][frame["triangle"]].mean(axis=1)
            self.assertAlmostEqual(state["curves"]["gravity_energy"][i],
                                   -(weight @ np.array(scene["environment"]["gravity"])).sum(), places=9)
            self.assertAlmostEqual(state["curves"]["surface_energy"][i],
                                   2 * scene["material"]["surface_tension"] * frame.area().sum(), places=12)
        self.assertGreater(state["speed"], 0)
        self.assertAlmostEqual(state["left"] * state["speed"], 0.2, places=6)
        status, page = watch.get("frame.html")
        self.assertEqual(status, 200)
        self.assertIn(f'"step":{int(self.rows[-1]["step"])}', page)
        self.assertEqual(watch.end(), 0)
        self.assertEqual(pathlib.Path("passed.sheet").read_bytes(), pathlib.Path("run.sheet").read_bytes())
        with self.assertRaises(urllib.error.URLError):
            watch.get("")

    def test_nothing_can_be_changed_and_names_of_elsewhere_are_refused(self):
        watch = self.watch()
        port = watch.url.split(":")[2][:-1]
        for method in ("POST", "PUT", "DELETE", "OPTIONS"):
            request = urllib.request.Request(watch.url, method=method, data=b"x")
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(request, timeout=10)
            self.assertEqual(refused.exception.code, 405)
            refused.exception.close()
        for name in ("evil.example", "127.0.0.1.evil.example", "127.evil.example", ""):
            self.assertEqual(watch.get("", Host=f"{name}:{port}")[0], 403, name)
        self.assertEqual(watch.get("", Host=f"localhost:{port}@evil.example")[0], 403)
        self.assertEqual(watch.get("", Host=f"localhost:{port}")[0], 200)
        for second, status in (b"", b"200"), (b"Host: evil.example\r\n", b"403"), (b"host: localhost\r\n", b"403"):
            with self.connect(watch, b"GET / HTTP/1.1\r\nHost: localhost\r\n" + second + b"\r\n") as client:
                self.assertEqual(client.recv(12), b"HTTP/1.1 " + status)
        self.assertEqual(watch.get("../../etc/passwd")[0], 404)
        for junk in (b"\r\n\r\n", b"GET\r\n\r\n", b"\0" * 20000, b"GET / HTTP/1.1\r\n" + b"a: b\r\n" * 5000):
            with socket.create_connection(("127.0.0.1", int(port)), timeout=10) as client:
                try:
                    client.sendall(junk)
                    client.recv(100)
                except OSError:
                    pass
        self.assertEqual(watch.get("")[0], 200)
        listening = [line.split()[1] for line in pathlib.Path("/proc/net/tcp").read_text().splitlines() if " 0A " in line]
        self.assertIn(f"0100007F:{int(port):04X}", listening)  # 127.0.0.1 only
        self.assertNotIn(f"00000000:{int(port):04X}", listening)
        self.assertEqual(watch.end(), 0)

    def connect(self, watch, request=b""):
        """A client that asks and does not read."""
        client = socket.socket()
        self.addCleanup(client.close)
        client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
        client.connect(("127.0.0.1", int(watch.url.split(":")[2][:-1])))
        client.sendall(request)
        return client

    def test_neither_the_run_nor_other_browsers_wait_for_a_hundred_that_stall(self):
        watch = self.watch()
        watch.give(self.run_of[0])
        watch.state_at(self.rows[0]["step"])
        whole = b"GET /frame.html HTTP/1.1\r\nHost: localhost\r\n\r\n"
        stalled = [self.connect(watch, whole[:(len(whole) - i if i % 2 else len(whole))]) for i in range(100)]
        start = time.monotonic()
        for row, frame in zip(self.rows[1:], self.run_of[1:]):
            watch.give(frame)
            watch.state_at(row["step"])
        self.assertEqual(watch.get("frame.html")[0], 200)
        self.assertLess(time.monotonic() - start, 4)  # less than what a stalled request is given
        self.assertEqual(len(stalled), 100)
        start = time.monotonic()
        self.assertEqual(watch.end(), 0)
        self.assertLess(time.monotonic() - start, 2)
        self.assertEqual(pathlib.Path("passed.sheet").read_bytes(), pathlib.Path("run.sheet").read_bytes())

    def test_more_idle_ones_than_there_are_connections_make_way(self):
        watch = self.watch()
        watch.give(self.run_of[0])
        watch.state_at(self.rows[0]["step"])
        idle = [self.connect(watch, b"") for _ in range(300)]
        start = time.monotonic()
        self.assertEqual(watch.get("frame.html")[0], 200)
        self.assertLess(time.monotonic() - start, 3)  # less than what an idle one is given
        self.assertEqual(len(idle), 300)
        self.assertEqual(watch.end(), 0)

    def test_a_request_that_does_not_end_is_given_up_and_a_slow_reader_gets_all(self):
        watch = self.watch()
        watch.give(self.run_of[0])
        watch.state_at(self.rows[0]["step"])
        unfinished = self.connect(watch, b"GET / HT")
        slow = self.connect(watch, b"GET /frame.html HTTP/1.1\r\nHost: localhost\r\n\r\n")
        got, start = b"", time.monotonic()
        while piece := slow.recv(1024):
            got += piece
            time.sleep(0.01)
        self.assertGreater(time.monotonic() - start, 0.5)
        self.assertEqual(got.split(b"\r\n\r\n", 1)[1].decode(), watch.get("frame.html")[1])
        unfinished.settimeout(10)
        self.assertEqual(unfinished.recv(100), b"")
        self.assertGreater(time.monotonic() - start, 4)
        self.assertEqual(watch.end(), 0)

    def test_other_addresses_are_answered_only_when_asked_for(self):
        watch = self.watch("--address", "0.0.0.0")
        port = watch.url.split(":")[2][:-1]
        for host in ("127.0.0.1", socket.gethostname(), "run.example"):
            request = urllib.request.Request(f"http://127.0.0.1:{port}/", headers={"Host": f"{host}:{port}"})
            with urllib.request.urlopen(request, timeout=10) as answer:
                self.assertEqual(answer.status, 200)
        listening = [line.split()[1] for line in pathlib.Path("/proc/net/tcp").read_text().splitlines() if " 0A " in line]
        self.assertIn(f"00000000:{int(port):04X}", listening)
        self.assertEqual(watch.end(), 0)

    def test_in_a_ring_the_run_is_the_same_byte_for_byte(self):
        ring = "sheet-init scene.toml | sheet-loop -q --no-provenance --steps 5 -- 'sheet-step --dt 0.01 | sheet-collide{}' > {}"
        done = subprocess.run(["bash", "-ec", ring.format("", "plain.sheet") + "; " +
                               ring.format(" | sheet-watch --port 0", "watched.sheet")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("http://127.0.0.1:", done.stderr)
        self.assertEqual(pathlib.Path("watched.sheet").read_bytes(), pathlib.Path("plain.sheet").read_bytes())

    def test_errors_name_the_port_and_the_remedy(self):
        with socket.create_server(("127.0.0.1", 0)) as other:
            port = str(other.getsockname()[1])
            self.assert_error(6, f"port {port}: Address already in use; choose another one", "--port", port)
        self.assert_error(2, "--port 70000 is none", "--port", "70000")
        self.assert_error(2, '"here" is no IPv4 address in digits', "--address", "here")

    def assert_error(self, code, message, *options):
        done = subprocess.run(["sheet-watch", *options, "run.sheet"], capture_output=True)
        self.assertEqual(done.returncode, code)
        self.assertIn(message, done.stderr.decode())

    def test_a_browser_shows_steps_as_they_come_and_keeps_its_view(self):
        watch = self.watch("--until", "0.4")
        with Browser(1100, 700) as browser:
            browser.call("Page.navigate", url=watch.url)
            browser.until("document.getElementById('message')?.textContent.includes('waiting')")
            eye_of = "new URLSearchParams(document.querySelector('#frames iframe').contentWindow.location.hash.slice(1)).get('eye')"
            shown = "document.querySelector('#frames iframe:not(.coming)')"
            for number, frame in enumerate(self.run_of[i] for i in (0, 3, -1)):
                watch.give(frame)
                browser.until(f"document.querySelector('#figures dd')?.textContent === '{frame.step}'")
                browser.until(f"{shown}?.src.includes('step={frame.step}') && "
                              f"{shown}.contentDocument.body?.dataset.state === 'ready'")
                if number == 0:
                    browser.js(f"{shown}.contentWindow.location.hash = 'colour=thickness'")
                    browser.until(f"{shown}.contentWindow.location.hash.includes('eye=')")
                if number == 1:
                    browser.drag(300, 400, 90, 20)
                    browser.until(f"{shown}.contentDocument.body.dataset.address === 'written'")
                    eye = browser.js(eye_of)
            self.assertEqual(browser.js(eye_of), eye)
            self.assertIn("colour=thickness", browser.js(f"{shown}.contentWindow.location.hash"))
            self.assertEqual(browser.js("document.querySelectorAll('#curves canvas').length"), 4)
            figures = browser.js("document.getElementById('figures').textContent")
            self.assertIn(f"time{self.run_of[-1].time:.4g} s", figures)
            self.assertIn("left", figures)
            self.assertEqual([c for c in browser.complaints() if not str(c).startswith(watch.url)], [])
            self.assertEqual(watch.end(), 0)
            browser.until("document.getElementById('message').textContent.includes('the run has ended')")


if __name__ == "__main__":
    unittest.main(verbosity=2)
