#!/usr/bin/env python3
"""The site builds without a warning, and every link and picture of its pages leads to a file and an anchor that are there.

usage: site.py SOURCE_DIR WORK_DIR
Skipped where mkdocs or its material theme is missing.
"""
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

source, work = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve() / "site"


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.anchors |= {found[key] for key in ("id", "name") if found.get(key)}
        link = found.get("href" if tag == "a" else "src" if tag == "img" else "")
        if link:
            self.links.append(link)


def dead(pages, exists):
    """Faults of pages {path: Page}; `exists(path)` of other files."""
    faults = []
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            to = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            anchor = urllib.parse.unquote(parts.fragment)
            if to not in pages and not exists(to):
                faults.append(f"{path.name}: {link}: no such file")
            elif to in pages and anchor and anchor not in pages[to].anchors and not anchor.startswith("__"):
                faults.append(f"{path.name}: {link}: no such anchor")
    return faults


def self_test():
    a, b = pathlib.Path("/a/a.html"), pathlib.Path("/a/b.html")
    pages = {a: Page('<a href="b.html#x"></a><a href="b.html#y"></a><a href="c.html"></a><img src="d.png">'), b: Page('<p id="x">')}
    return len(dead(pages, lambda path: False)) == 3


shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
done = subprocess.run(["bash", str(source / "docs/site.sh"), str(work)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
print(done.stdout)
if "skipped:" in done.stdout:
    sys.exit(77)
if done.returncode:
    sys.exit("the site does not build")
pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted((work / "site").rglob("*.html")) if path.name != "404.html"}
faults = dead(pages, lambda path: path.exists()) + ([] if self_test() else ["self test failed"])
names = {path.relative_to(work / "site").as_posix() for path in pages}
for needed in ("index.html", "keywords/index.html", "keywords/mat.html", "tutorials/first_water.html", "python_reference.html"):
    if needed not in names:
        faults.append(f"there is no {needed}")
keywords = (source / "docs/keywords.md").read_text(encoding="utf-8")
for anchor in re.findall(r'<a id="([^"]+)"></a>', keywords):
    if not any(anchor in page.anchors for path, page in pages.items() if path.parent.name == "keywords"):
        faults.append(f"no page of keywords has {anchor}")
materials = (work / "site/keywords/mat.html").read_text(encoding="utf-8")
sections = re.split(r"<h2", materials)[1:]
for section in sections:
    if 'class="state ' not in section:
        faults.append(f"a section of materials has no state: {section[:60]}")
if len(sections) < 40 or not any("mat_024" in section and "Decks that use it:" in section for section in re.split(r'(?=<a id="mat_)', materials)):
    faults.append("the page of materials lacks sections, or the decks that use *MAT_024")
print("\n".join(faults) or f"{len(pages)} pages, {sum(len(p.links) for p in pages.values())} links")
sys.exit(1 if faults else 0)
