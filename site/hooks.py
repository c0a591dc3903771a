# SPDX-License-Identifier: GPL-3.0-or-later
"""What mkdocs does besides: formulas become HTML by Debian's KaTeX, and the search's index a script, so that the site
works from a folder, too."""
import html
import json
import pathlib
import re
import shutil
import subprocess

KATEX = pathlib.Path("/usr/share/javascript/katex")
here = pathlib.Path(__file__).resolve().parent
FORMULA = re.compile(r"(?m)^ *\$\$([^$]+?)\$\$ *$|(?<![\\$`\w])\$(?=[^\s$])([^$\n]*(?:\n[^$\n]+)*?[^\s$])\$(?![\d\w$])")
CODE = re.compile(r"```.*?```|`[^`\n]+`|(?:(?:^|(?<=\n))(?: {4,}[^\n]*(?:\n|$))+)", re.S)
CODE_WITH_BAR = re.compile(r"`([^`\n]*\\\|[^`\n]*)`")
_formulas = []


def on_page_markdown(markdown, **_):
    """Takes formulas out of the page before Markdown looks at it; code keeps its dollars."""
    kept = []

    def keep(match):
        kept.append(match[0])
        return f"\x02{len(kept) - 1}\x02"

    def take(match):
        _formulas.append({"tex": match[1] or match[2], "display": bool(match[1])})
        return f"SHEETFORMULA{len(_formulas) - 1}Z"

    text = FORMULA.sub(take, CODE.sub(keep, markdown))
    text = re.sub("\x02(\\d+)\x02", lambda match: kept[int(match[1])], text)
    return re.sub(r"(?m)^\|.*$", lambda match: CODE_WITH_BAR.sub(bars, match[0]), text)


def bars(code):
    """Code of a table's cell that has bars, which Markdown would leave escaped."""
    return "<code>" + html.escape(code[1].replace("\\|", "|")).replace("|", "&#124;") + "</code>"


def on_post_build(config, **_):
    """Renders all formulas in one go and puts them into the pages; writes the index of the search as a script."""
    site = pathlib.Path(config["site_dir"])
    done = subprocess.run(["node", here / "formulas.js", KATEX / "katex.js"], input=json.dumps(_formulas), text=True,
                          capture_output=True)
    if done.returncode:
        raise RuntimeError(done.stderr)
    shown = json.loads(done.stdout)

    def put(match):
        return shown[int(match[1])]

    for page in site.rglob("*.html"):
        if page.parent.name != "views":
            page.write_text(re.sub(r"SHEETFORMULA(\d+)Z", put, page.read_text()))
    index = json.loads((site / "search/search_index.json").read_text())
    for entry in index["docs"]:
        for field in ("title", "text"):
            entry[field] = html.unescape(re.sub(r"SHEETFORMULA(\d+)Z", lambda m: _formulas[int(m[1])]["tex"],
                                                entry[field]))
    entries = [[entry["location"], entry["title"], " ".join(entry["text"].split())] for entry in index["docs"]]
    (site / "index.js").write_text("window.sheetIndex = " + json.dumps(entries, ensure_ascii=False) + ";\n")
    shutil.rmtree(site / "search")
    for map_of_site in site.glob("sitemap.xml*"):  # for search engines, with times; a folder has none
        map_of_site.unlink()
    shutil.copy(KATEX / "katex.min.css", site / "katex.css")
    (site / "fonts").mkdir(exist_ok=True)
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copy(font, site / "fonts")
