#!/usr/bin/env python3
"""Each tutorial and README.md do what they say: files are written, commands run and pictures made, in an empty folder, as a reader would do it.

usage: tutorials.py COURANT SOURCE_DIR WORK_DIR [--write] [NAME...]
Of a page of docs/tutorials (of README.md the blocks `sh`):
- a block `sh` runs by bash; a comment `# exit code N` names the code that it ends with, 0 else;
- another block below a line that ends with `NAME`: is written to the file NAME;
- a block `text` is what the commands before it print: its lines are there in this order, those of dots are any others; a block without a word is shown alone;
- each picture is made by the run under the same name and looks the same: means over 24 x 24 fields differ by less than 0.006 of white in
  the mean. That is twice what other instruction sets change, whose last bits move the drops of breaking water (0.003 of a sweep);
- the report in docs/user_guide.md is that of `courant check`;
- blocks below a line with "Optional" and `pip install PACKAGE` are left out, with a word, where the package is missing.
--write copies the pictures of the run to docs/figures/tutorials.
"""
import importlib.util
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

from checks import check, failures

LONGEST_PAGE = 150  # lines
SECONDS = 240  # of processor time, all pages together
MODULES = {"ansys-dyna-core": "ansys.dyna.core", "vtk": "vtkmodules", "pyvista": "pyvista"}  # by name of the package


def blocks(text):
    """(language, line above the block, content, package that the section needs or None) of each fenced block."""
    found, optional, above, lines = [], None, "", iter(text.splitlines())
    for line in lines:
        if line.startswith("```"):
            content = []
            for inner in lines:
                if inner.startswith("```"):
                    break
                content.append(inner)
            found.append((line[3:].strip(), above, "\n".join(content) + "\n", optional))
            above = ""
        elif line.strip():
            if line.startswith("#"):
                optional = None
            named = re.search(r"Optional.*`pip install ([\w-]+)`", line)
            optional, above = named.group(1) if named else optional, line
    return found


def shown(expected, output):
    """The first line of a text block that the output does not have in its position, None if all are there."""
    rest = [" ".join(line.split()) for line in output.splitlines()]
    for line in expected.splitlines():
        wanted = " ".join(line.split())
        if wanted in ("", "..."):
            continue
        if wanted not in rest:
            return line
        rest = rest[rest.index(wanted) + 1:]
    return None


def missing(package):
    try:
        return importlib.util.find_spec(MODULES[package]) is None
    except ModuleNotFoundError:
        return True


def fields(picture):
    """Means of the grey of a picture over 24 x 24 fields."""
    import matplotlib.image
    import numpy as np

    grey = matplotlib.image.imread(picture)[..., :3].mean(axis=2)
    rows, columns = (np.linspace(0, size, 25).astype(int) for size in grey.shape)
    return np.array([[grey[a:b, c:d].mean() for c, d in zip(columns, columns[1:])] for a, b in zip(rows, rows[1:])])


def run_page(page, folder, environment):
    output, text = "", page.read_text(encoding="utf-8")
    for language, above, content, package in blocks(text):
        name = re.search(r"`([^`]+)`:$", above)
        if package and missing(package):
            print(f"{page.stem}: skipped what needs {package}: it is missing")
        elif name and language != "sh":
            path = folder / name.group(1)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content, encoding="utf-8")
        elif language == "text":
            lacking = shown(content, output)
            check(lacking is None, f"{page.stem}: the commands print what the page shows")
            if lacking is not None:
                print(f"the page: {lacking}\nthe commands:\n{output[-6000:]}")
        elif not language:
            continue  # shown to the reader alone
        elif language == "sh":
            code = re.search(r"# exit code (\d+)", content)
            done = subprocess.run(["bash", "-e", "-c", content], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600)
            output = done.stdout
            check(done.returncode == int(code.group(1) if code else 0), f"{page.stem}: {content.strip().splitlines()[0]} ends with {done.returncode}")
            if done.returncode != int(code.group(1) if code else 0):
                print(output)
                return
        else:
            check(False, f"{page.stem}: a block `{language}` without a name of a file is neither run nor compared: {content.splitlines()[0]}")


def compare_pictures(page, folder, write):
    import numpy as np

    for target in re.findall(r"!\[[^\]]*\]\((\S+?)\)", page.read_text(encoding="utf-8")):
        picture = (page.parent / target).resolve()
        made = [path for path in folder.rglob(picture.name)]
        check(len(made) == 1, f"{page.stem}: the run makes {picture.name} once")
        if made and write:
            picture.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(made[0], picture)
        elif made:
            difference = np.abs(fields(made[0]) - fields(picture)).mean()
            check(difference < 0.006, f"{page.stem}: {picture.name} looks as on the page: difference {difference:.4f}")


def self_test():
    page = "A\n\nSave this as `a.txt`:\n\n```yaml\nx\n```\n\n```sh\nls  # exit code 2\n```\n\n## B\n\nOptional, `pip install pyvista`:\n\n```sh\ny\n```\n\n## C\n\n```text\nz\n```\n"
    kinds = [(language, content, package) for language, _, content, package in blocks(page)]
    return (kinds == [("yaml", "x\n", None), ("sh", "ls  # exit code 2\n", None), ("sh", "y\n", "pyvista"), ("text", "z\n", None)]
            and shown("a\n...\nc  d\n", "a\nb\nc d\n") is None and shown("c\na\n", "a\nc\n") == "a")


def main():
    words = [word for word in sys.argv[4:] if word != "--write"]
    courant, source, work = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    for needed in ("matplotlib", "h5py", "yaml", "vtkmodules"):
        if importlib.util.find_spec(needed) is None:
            print(f"skipped: Python's {needed} is not here")
            return 77
    check(self_test(), "self test")
    environment = os.environ | {"PATH": f"{courant.parent}:/usr/bin:{os.environ['PATH']}", "COURANT": str(source), "MPLBACKEND": "Agg",
                                "PYTHONPATH": os.pathsep.join(filter(None, [str(source / "src/python"), os.environ.get("PYTHONPATH")])),
                                "PYTHONDONTWRITEBYTECODE": "1"}
    environment.pop("COURANT_EXECUTABLE", None)  # a reader has none
    pages = [page for page in sorted((source / "docs/tutorials").glob("*.md")) if page.name != "README.md"]
    check(len(pages) >= 7, "there are seven tutorials")
    for page in pages:
        check(len(page.read_text(encoding="utf-8").splitlines()) <= LONGEST_PAGE, f"{page.stem} has at most {LONGEST_PAGE} lines")
    used = 0.0
    for page in [source / "README.md", *pages]:
        if words and page.stem not in words:
            continue
        folder = work / "tutorials" / page.stem
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        if page.stem == "README":  # its commands are typed in the folder of the project
            (folder / "keyword_decks").symlink_to(source / "keyword_decks")
        before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.time()
        run_page(page, folder, environment)
        if page.stem != "README":
            compare_pictures(page, folder, "--write" in sys.argv)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        print(f"{page.stem}: {time.time() - begin:.1f} s, {seconds:.1f} s of processor time")
        used += seconds
    if not words:
        report = subprocess.run([courant, "check", "keyword_decks/hydraulic_jump/d4_5s.k"], cwd=source, stdout=subprocess.PIPE, text=True, timeout=60).stdout
        (block,) = re.findall(r"^```text\n(.*?)^```", (source / "docs/user_guide.md").read_text(encoding="utf-8"), re.M | re.S)
        # the estimate of the run time is of this machine
        lacking = shown(re.sub(r"about \d+ s", "about T s", block), re.sub(r"about \d+ s", "about T s", report))
        check(lacking is None, f"user_guide.md shows the report of `courant check` as it is printed{'' if lacking is None else ': not ' + lacking}")
    check(used < SECONDS, f"{used:.0f} s of processor time, at most {SECONDS}")
    return f"{len(failures)} failed" if failures else 0


if __name__ == "__main__":
    sys.exit(main())
