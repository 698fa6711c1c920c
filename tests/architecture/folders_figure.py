#!/usr/bin/env python3
"""Draws the folders of src/ and how their #include lines point, as docs/architecture.md shows them.

usage: folders_figure.py PROJECT_FOLDER OUT.svg [--at COMMIT]
A folder is above all that it includes. Arrows that follow from others are left out (a -> c where a -> b -> c), and those of app,
which includes everything. Blue folders are physics. Boxes give files and hundreds of lines. The same sources give the same bytes.
"""
import collections
import io
import pathlib
import re
import subprocess
import sys
import tarfile

TOP = "app"
PHYSICS = {"loads", "laws", "materials", "sph", "elements", "surfaces", "rigid", "shell", "contact"}
BOX, GAP, LAYER, HEIGHT, WIDTH = 120, 22, 92, 42, 980


def sources(project, commit):
    """Name below src/ and text of each file, now or at a commit."""
    if commit is None:
        return [(p.relative_to(project / "src"), p.read_text("utf-8")) for p in sorted((project / "src").rglob("*.[ch]pp"))]
    packed = subprocess.run(["git", "-C", project, "archive", commit, "src"], check=True, stdout=subprocess.PIPE).stdout
    with tarfile.open(fileobj=io.BytesIO(packed)) as files:
        return [(pathlib.Path(m.name).relative_to("src"), files.extractfile(m).read().decode("utf-8"))
                for m in sorted(files.getmembers(), key=lambda m: m.name) if m.name.endswith((".cpp", ".hpp"))]


def folders_of(files):
    """Files and lines of each folder, and the folders that each includes."""
    size, below = collections.defaultdict(lambda: [0, 0]), collections.defaultdict(set)
    for name, text in files:
        folder = name.parts[0]
        size[folder][0] += 1
        size[folder][1] += text.count("\n")
        below[folder] |= set(re.findall(r'^\s*#\s*include\s*"(\w+)/', text, re.M)) - {folder}
    return dict(size), {folder: sorted(below[folder]) for folder in sorted(size)}


def reach(below, folder):
    return {folder}.union(*(reach(below, b) for b in below[folder]))


def layered(below):
    """Layers from the bottom up; an arrow over several layers has a position of its own in each (a tuple), so that it meets no box."""
    direct = {r: [b for b in below[r] if not any(b in reach(below, o) for o in below[r] if o != b)] for r in below if r != TOP}
    level = {}
    for folder in sorted(direct, key=lambda r: (len(reach(below, r)), r)):
        level[folder] = 1 + max((level[b] for b in direct[folder]), default=-1)
    layers = [sorted(r for r in level if level[r] == n) for n in range(max(level.values()) + 1)]
    steps = []  # arrows from one layer to the next
    for folder in sorted(direct):
        for target in direct[folder]:
            path = [folder] + [(folder, target, n) for n in range(level[folder] - 1, level[target], -1)] + [target]
            for node, n in zip(path[1:-1], range(level[folder] - 1, level[target], -1)):
                layers[n].append(node)
            steps.append(path)
    return layers, steps


def place(layers, paths):
    """x of every node: each layer in the order of the mean of what it is tied to, sweeps up and down."""
    ties = collections.defaultdict(list)
    for path in paths:
        for upper, lower in zip(path, path[1:]):
            ties[upper].append(lower), ties[lower].append(upper)
    x = {}

    def lay(layer):
        width = lambda node: BOX if isinstance(node, str) else 8
        at = (WIDTH - sum(width(n) for n in layer) - GAP * (len(layer) - 1)) / 2
        for node in layer:
            x[node] = at + width(node) / 2
            at += width(node) + GAP

    for layer in layers:
        lay(layer)
    for sweep in range(24):
        for layer in layers if sweep % 2 else reversed(layers):
            mean = {n: sum(x[t] for t in ties[n]) / max(len(ties[n]), 1) for n in layer}
            layer.sort(key=lambda n: (round(mean[n], 3), str(n)))
            lay(layer)
    return x


def draw(size, below):
    layers, paths = layered(below)
    x = place(layers, paths)
    top = 62
    y = {node: top + LAYER * (len(layers) - 1 - n) + 30 for n, layer in enumerate(layers) for node in layer}
    height = top + LAYER * (len(layers) - 1) + 30 + HEIGHT + 12
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif" font-size="14">',
           '<defs><marker id="a" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
           '<path d="M0 0L8 4L0 8z" fill="#456"/></marker></defs>', f'<rect width="{WIDTH}" height="{height}" fill="#fff"/>']
    for path in paths:
        line = f"M{x[path[0]]:.0f} {y[path[0]] + HEIGHT}"
        for node, following in zip(path, path[1:]):
            y0, y1 = y[node] + HEIGHT, y[following]
            line += f"C{x[node]:.0f} {(y0 + y1) / 2:.0f} {x[following]:.0f} {(y0 + y1) / 2:.0f} {x[following]:.0f} {y1}"
            line += "" if following == path[-1] else f"V{y1 + HEIGHT}"
        out.append(f'<path d="{line}" fill="none" stroke="#456" stroke-width="1.2" marker-end="url(#a)"/>')

    def box(left, above, width, folder):
        files, lines = size[folder]
        out.append(f'<rect x="{left:.0f}" y="{above}" width="{width}" height="{HEIGHT}" rx="5" fill="{"#cfe3f7" if folder in PHYSICS else "#f4f4f0"}" stroke="#456"/>'
                   f'<text x="{left + width / 2:.0f}" y="{above + 18}" text-anchor="middle" font-weight="bold">{folder}</text>'
                   f'<text x="{left + width / 2:.0f}" y="{above + 34}" text-anchor="middle" font-size="11">{files} files, {round(lines, -2) or lines} lines</text>')

    box(20, 10, WIDTH - 40, TOP)
    for layer in layers:
        for node in layer:
            if isinstance(node, str):
                box(x[node] - BOX / 2, y[node], BOX, node)
    return "\n".join(out) + "\n</svg>\n"


if __name__ == "__main__":
    at = sys.argv[sys.argv.index("--at") + 1] if "--at" in sys.argv else None
    pathlib.Path(sys.argv[2]).write_text(draw(*folders_of(sources(pathlib.Path(sys.argv[1]), at))), encoding="utf-8")
