#!/usr/bin/env python3
"""Puts the pages of the project together for mkdocs.

usage: build.py PROJECT_FOLDER BUILD_FOLDER
Writes BUILD_FOLDER/site_pages and BUILD_FOLDER/mkdocs.yml; docs/site.sh then calls mkdocs. The pages are those of docs, README.md as the first one, and
the README of each ready deck; docs/keywords.md becomes one page per family. Files that pages link to are copied beside them.
"""

from __future__ import annotations

import os
import posixpath
import shutil
import subprocess
import sys
from pathlib import Path

import yaml

sys.path.insert(0, str(Path(__file__).parent))
from keyword_pages import KeywordPages, decks_by_keyword  # noqa: E402
from links import EXTERNAL, headings, outside_code, pages, rewritten  # noqa: E402
from python_reference import page as python_reference  # noqa: E402


def page_name(source: str) -> str:
    """Where a file of the project is in the site."""
    if source == "README.md":
        return "index.md"
    if source == "docs/keywords.md":
        return "keywords/index.md"
    if source.startswith("docs/"):
        return source.removeprefix("docs/")
    if source.startswith("keyword_decks/") and source.endswith("/README.md"):
        return f"decks/{source.split('/')[1]}.md"
    return f"files/{source}"


class Site:
    def __init__(self, project: Path, build: Path):
        self.project, self.pages, self.config = project, build / "site_pages", build / "mkdocs.yml"
        self.keywords = KeywordPages((project / "docs/keywords.md").read_text(encoding="utf-8"), decks_by_keyword(project, self.generated_decks()))

    def generated_decks(self) -> dict[str, str]:
        """Decks of the ready scenes: a scene names few keywords itself. Without the package's needs (numpy) there are none."""
        texts = {}
        for scene in sorted(self.project.glob("keyword_decks/*/scene.yaml")):
            call = [sys.executable, "-B", "-m", "courant", "generate", str(scene), "-o", "/dev/stdout"]
            done = subprocess.run(call, env=os.environ | {"PYTHONPATH": str(self.project / "src/python")}, capture_output=True, text=True)
            if done.returncode == 0:
                texts[scene.relative_to(self.project).as_posix()] = done.stdout
        return texts

    def target(self, source: str, page: str, link: str) -> str:
        """The link of a source file as a link of its page in the site."""
        if link.startswith(EXTERNAL) or link.startswith("#") and source != "docs/keywords.md":
            return link
        path, _, anchor = link.partition("#")
        if path.startswith("/"):
            found = path[1:]
        else:
            found = posixpath.normpath(posixpath.join(posixpath.dirname(source), path)) if path else source
        if found == "docs/keywords.md":
            to = "keywords/" + self.keywords.page_of(anchor)
        elif (self.project / found).is_dir():
            readme = posixpath.join(found, "README.md")
            to = page_name(readme) if (self.project / readme).is_file() else self.listing(found)
        else:
            to = page_name(found)
            self.copy(found, to)
        return posixpath.relpath(to, posixpath.dirname(page) or ".") + ("#" + anchor if anchor else "")

    def copy(self, source: str, to: str) -> None:
        if (to.startswith("files/") or not to.endswith(".md")) and (self.project / source).is_file():
            (self.pages / to).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(self.project / source, self.pages / to)

    def listing(self, folder: str) -> str:
        """A text file with the names in a folder that a page links to."""
        to = f"files/{folder}/contents.txt"
        (self.pages / to).parent.mkdir(parents=True, exist_ok=True)
        (self.pages / to).write_text("".join(f"{p.name}\n" for p in sorted((self.project / folder).iterdir())), encoding="utf-8")
        return to

    def write(self, page: str, source: str, text: str) -> None:
        text = rewritten(text, lambda link: self.target(source, page, link))
        anchor_of = {number: anchor for number, _, anchor in headings(text)}
        lines = []
        for number, line, is_text in outside_code(text):
            before = lines[-1] if lines else ""
            # Python-Markdown wants an empty line in front of a list, GitHub does not.
            if is_text and line.startswith(("- ", "1. ")) and before and not before.startswith(("- ", "1. ", " ", "#", "```")):
                lines.append("")
            lines.append(line.rstrip("# ") + f" {{#{anchor_of[number]}}}" if number in anchor_of and anchor_of[number] else line)
        (self.pages / page).parent.mkdir(parents=True, exist_ok=True)
        (self.pages / page).write_text("\n".join(lines) + "\n", encoding="utf-8")

    def build(self) -> None:
        shutil.rmtree(self.pages, ignore_errors=True)
        for path in pages(self.project):
            source = path.relative_to(self.project).as_posix()
            if source != "docs/keywords.md":
                self.write(page_name(source), source, path.read_text(encoding="utf-8"))
        for of in self.keywords.sections:
            self.write(f"keywords/{of}.md", "docs/keywords/.", self.keywords.family_page(of))
        self.write("keywords/index.md", "docs/keywords/.", self.keywords.index().replace("(cannot_do.md)", "(/docs/cannot_do.md)"))
        self.write("python_reference.md", "docs/python_reference.md", python_reference(self.project))
        shutil.copyfile(Path(__file__).with_name("extra.css"), self.pages / "extra.css")
        settings = yaml.safe_load(Path(__file__).with_name("mkdocs.yml").read_text(encoding="utf-8"))
        families = [{f"*{of.upper()}": f"keywords/{of}.md"} for of in sorted(self.keywords.sections)]
        settings["nav"] = filled_in(settings["nav"], families)
        settings |= {"docs_dir": str(self.pages), "site_dir": str(self.config.parent / "site")}
        self.config.write_text(yaml.safe_dump(settings, sort_keys=False, allow_unicode=True), encoding="utf-8")


def filled_in(nav, families: list):
    """The navigation with the pages of the families in place of the word FAMILIES."""
    if isinstance(nav, list):
        return [entry for item in nav for entry in (families if item == "FAMILIES" else [filled_in(item, families)])]
    return {key: filled_in(value, families) for key, value in nav.items()} if isinstance(nav, dict) else nav


if __name__ == "__main__":
    Site(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()).build()
