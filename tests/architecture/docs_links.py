#!/usr/bin/env python3
"""Every link within the pages leads to a page and a heading that exist, and the navigation of the site has each page once.

usage: docs_links.py PROJECT_FOLDER
Needs neither mkdocs nor a build. Anchors are those that GitHub gives headings; docs/site/build.py gives the site the same.
"""
import pathlib
import re
import sys

project = pathlib.Path(sys.argv[1]).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(project / "docs/site"))
from links import EXTERNAL, anchors, links, pages, slug  # noqa: E402

MADE_BY_THE_SITE = {"python_reference.md", "FAMILIES"}


def dead_links(page, text, anchors_of):
    """Faults of one page; `anchors_of(path)`: anchors of another page, None where it is no page of Markdown."""
    faults = []
    for number, target in links(text):
        if target.startswith(EXTERNAL):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        where = f"{page.relative_to(project)}:{number}: "
        if file != page and not file.exists():
            faults.append(where + f"link to '{path}': there is no such file")
        elif anchor:
            known = anchors_of(file)
            if known is not None and anchor not in known:
                faults.append(where + f"link to '{target}': the page has no heading or anchor '{anchor}'")
    return faults


def navigation_faults(text, names):
    """Pages that the navigation of the site lacks, has twice, or has without a file."""
    listed = re.findall(r"([\w/]+\.md)\b", text.split("\nnav:")[1])
    faults = [f"docs/site/mkdocs.yml: {name} is there twice" for name in sorted(set(listed)) if listed.count(name) > 1]
    faults += [f"docs/site/mkdocs.yml: the navigation lacks {name}" for name in sorted(names - set(listed))]
    return faults + [f"docs/site/mkdocs.yml: there is no page {name}" for name in sorted(set(listed) - names - MADE_BY_THE_SITE)]


def site_name(page):
    name = page.relative_to(project).as_posix()
    if name == "README.md":
        return "index.md"
    if name == "docs/keywords.md":
        return "keywords/index.md"
    return f"decks/{page.parent.name}.md" if name.startswith("keyword_decks/") else name.removeprefix("docs/")


def self_test():
    page = project / "docs/x.md"
    text = "# A `b` (c), d\n\n## A `b` (c), d\n\n[1](#a-b-c-d) [2](#a-b-c-d-1) [3](#no) [4](no.md) [5](style.md#no) `[6](no.md)`\n\n```\n[7](no.md)\n```\n"
    found = dead_links(page, text, lambda path: anchors(text) if path == page else {"terms"})
    bad_nav = navigation_faults("\nnav:\n  - a.md\n  - a.md\n  - b.md\n", {"a.md", "c.md"})
    return [re.sub(r".*link to '([^']*)'.*", r"\1", fault) for fault in found] == ["#no", "no.md", "style.md#no"] and len(bad_nav) == 3 and slug("What's *MAT_024*?") == "whats-mat_024"


def main():
    known = {page: anchors(page.read_text(encoding="utf-8")) for page in pages(project)}
    faults = [] if self_test() else ["self test failed"]
    for page in known:
        faults += dead_links(page, page.read_text(encoding="utf-8"), known.get)
    faults += navigation_faults((project / "docs/site/mkdocs.yml").read_text(encoding="utf-8"), {site_name(page) for page in known})
    print("\n".join(faults) or f"all links of {len(known)} pages lead somewhere")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
