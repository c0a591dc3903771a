#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The site: every link leads somewhere, nothing is fetched from a network, formulas are rendered, each program has a page from
its own help, the search finds in a browser; and the tutorial can be typed."""
import html.parser
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
import urllib.parse

from browser import Browser

root = pathlib.Path(__file__).resolve().parents[2]
programs = pathlib.Path(os.environ["SHEET_PROGRAMS"])
LOADED = {("script", "src"), ("link", "href"), ("img", "src"), ("video", "src"), ("iframe", "src")}


class Page(html.parser.HTMLParser):
    """The ids, links and text of a page."""

    def __init__(self, file):
        super().__init__()
        self.ids, self.links, self.text = set(), [], ""
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.ids.add(value)
            elif name in ("href", "src"):
                self.links.append((tag, name, value))

    def handle_data(self, data):
        self.text += data


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.site = pathlib.Path(cls.folder.name) / "site"
        runs = pathlib.Path(cls.folder.name) / "out/drape"
        runs.mkdir(parents=True)
        subprocess.run(f"sheet-init --example | sheet-init - --set sheet.edge_length=0.2 -o {runs}/run.sheet", shell=True, check=True)
        done = subprocess.run([root / "site/make", "--programs", programs, "--runs", runs.parent, "-o", cls.site],
                              capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        cls.pages = {p: Page(p) for p in cls.site.rglob("*.html") if p.parent.name != "views"}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_link_leads_somewhere(self):
        self.assertGreater(len(self.pages), 50)
        checked = 0
        for file, page in self.pages.items():
            for tag, name, link in page.links:
                parts = urllib.parse.urlsplit(link)
                if parts.scheme or parts.netloc:
                    self.assertNotIn((tag, name), LOADED, f"{file}: {link} is fetched from a network")
                    continue
                target = (file.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else file
                self.assertTrue(target.is_file(), f"{file.relative_to(self.site)}: {link}")
                if parts.fragment:
                    self.assertIn(parts.fragment, self.pages[target].ids, f"{file.relative_to(self.site)}: {link}")
                checked += 1
        self.assertGreater(checked, 1500)

    def test_nothing_else_is_fetched(self):
        for file in [*self.site.glob("*.css"), *self.site.glob("*.js")]:
            if file.name != "index.js":
                self.assertIsNone(re.search(r"(url\(|import |fetch\(|src=)['\"]?(https?:)?//", file.read_text()), file)

    def test_formulas_are_rendered(self):
        model = (self.site / "model.html").read_text()
        self.assertGreater(model.count('class="katex"'), 100)
        self.assertEqual(model.count("katex-error"), 0)
        for file, page in self.pages.items():
            self.assertNotIn("SHEETFORMULA", file.read_text(), file)
            if file.name not in ("changelog.html", "contributing.html"):
                raw = re.search(r"\$[\\a-zA-Z][^$]{0,40}\\[a-z]+[^$]*\$", re.sub(r"\$ .*", "", page.text))
                self.assertIsNone(raw, file)

    def test_tables_show_bars_and_links_show_titles(self):
        for file, page in self.pages.items():
            self.assertNotIn("\\|", re.sub(r"<pre>.*?</pre>", "", file.read_text(), flags=re.S), file)
            self.assertIsNone(re.search(r">[\w./-]+\.md</a>", file.read_text()), file)
        self.assertIn("sheet-init scene.toml | sheet-loop", self.pages[self.site / "install.html"].text)

    def test_every_program_has_a_page_from_its_help(self):
        names = sorted(p.name for p in programs.glob("sheet-*"))
        self.assertGreater(len(names), 15)
        for name in names:
            told = subprocess.run([programs / name, "--help"], capture_output=True, text=True, check=True).stdout
            self.assertIn(told.strip(), self.pages[self.site / f"programs/{name}.html"].text)

    def test_scenes_that_were_run_have_a_view(self):
        self.assertIn("views/drape.html", (self.site / "scenes/drape.html").read_text())
        self.assertGreater((self.site / "views/drape.html").stat().st_size, 50000)

    def test_in_a_browser_the_search_finds_and_narrow_pages_do_not_scroll_sideways(self):
        with Browser(1000, 800) as browser:
            def look(page):
                browser.call("Page.navigate", url=f"file://{self.site}/{page}")
                browser.until("document.readyState === 'complete' && window.sheetIndex && "
                              f"location.href.includes('{page.split('?')[0]}')")

            look("index.html?q=blender%20motion%20blur")
            self.assertTrue(browser.js("document.querySelector('#found a[href*=\"blender.html\"]') !== null"))
            look("index.html?q=zzzunheardof%20%3Cb%3E")
            self.assertEqual(browser.js("document.getElementById('found').textContent"), "Nothing found")
            browser.size(420, 900, True)
            for page in ("index.html", "model.html", "gallery.html", "programs/sheet-step.html", "tutorial.html"):
                look(page)
                browser.js("document.fonts.ready.then(() => 1)")
                self.assertEqual(browser.js("document.documentElement.scrollWidth"), 420, page)
            self.assertEqual([c for c in browser.complaints() if not str(c).startswith("data:")], [])


class Tutorial(unittest.TestCase):
    def test_its_commands_run(self):
        commands = []
        for line in (root / "docs/tutorial.md").read_text().split("\n"):
            if line.startswith("    $ "):
                commands.append(line[6:])
            elif commands and "<< 'END'" in commands[-1] and not commands[-1].endswith("\nEND"):
                commands[-1] += "\n" + line[4:]
        self.assertEqual(len(commands), 14)
        script = "\n".join(commands).replace("--until 0.3", "--until 0.05").replace('"20 mm"', '"40 mm"').replace(
            "14 mm", "30 mm").replace("320x180", "64x36").replace("--until 0.5", "--until 0.05")
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(["bash", "-ec", "set -o pipefail\n" + script], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            for name in ("run.html", "compare.html", "hang.mp4", "run.csv", "ribbon-draft/film.mp4"):
                self.assertGreater((pathlib.Path(folder) / name).stat().st_size, 500, name)
            self.assertIn("Reynolds = rho V L / mu = 12", done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
