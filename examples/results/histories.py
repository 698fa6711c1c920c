#!/usr/bin/env python3
"""Reads and draws histories of a run, from the text files or from history.h5.

    python3 histories.py RESULTS                       what there is, in all kinds of files
    python3 histories.py RESULTS energies.png          energies over time, from glstat and from history.h5
"""
import os
import re
import sys

NUMBER = r"[-+]?\d*\.?\d+(?:[EeDd][-+]?\d+)?"


def read_glstat(path):
    """Columns of glstat by their labels: {"time": [...], "kinetic energy": [...], ...}"""
    columns = {}
    with open(path) as file:
        for line in file:
            if len(line) >= 46 and line[0] == " " and "." in line[1:32] and not line.startswith(" dt of"):
                columns.setdefault(line[1:32].rstrip(".").strip(), []).append(float(line[32:46]))
    return columns


def read_nodout(path):
    """Of each node rows of time and 12 numbers: displacement, velocity, acceleration, place (x, y, z each)."""
    nodes, time, reads = {}, None, False
    with open(path) as file:
        for line in file:
            if line.startswith(" n o d a l   p r i n t"):
                time = float(line[line.index("( at time") + 9:line.rindex(")")])
            elif line.startswith(" nodal point"):
                reads = "x-disp" in line
            elif reads and line.strip():
                numbers = [float(line[10 + 12 * k:22 + 12 * k]) for k in range(12)]
                nodes.setdefault(int(line[:9]), []).append([time, *numbers])
    return nodes


def pairs(text):
    """Of "x-mom= 1.0 y-mom= 2.0" the names and numbers."""
    return {name: float(value) for name, value in re.findall(rf"(\S+)=\s*({NUMBER})", text)}


def read_labelled(path, state, row):
    """Of files whose rows name their numbers (matsum, bndout): {"mat 1": [{"t": .., "name": ..}, ...]}"""
    found, time, last = {}, None, None
    with open(path) as file:
        for line in file:
            if state in line:
                time, last = float(re.findall(NUMBER, line.split("=")[-1])[0]), None
            elif begins := re.match(row, line):
                last = {"t": time}
                found.setdefault(" ".join(begins.groups()), []).append(last)
                last.update(pairs(line[begins.end():]))
            elif last is not None and "=" in line and "total=" not in line:
                last.update(pairs(line))
    return found


def read_rcforc(path):
    """{("SURFA", 1): [(time, {"x": .., "y": .., "z": .., "mass": ..}), ...]}"""
    found = {}
    with open(path) as file:
        for line in file:
            words = line.split()
            if len(words) > 3 and words[0] in ("SURFA", "SURFB") and words[2] == "time":
                values = {name: float(value) for name, value in zip(words[4::2], words[5::2])}
                found.setdefault((words[0], int(words[1])), []).append((float(words[3]), values))
    return found


def read_rows(path, state, time_behind, row):
    """Of files whose rows begin with an id: {id: [(time, the numbers behind it), ...]}; sphout has four rows a time."""
    found, time = {}, None
    with open(path) as file:
        for line in file:
            if state in line:
                time = float(re.search(rf"{time_behind}\s*({NUMBER})", line).group(1))
            elif time is not None and (begins := re.match(row, line)):
                numbers = [float(value) for value in re.findall(NUMBER, line[begins.end():])]
                found.setdefault(int(begins.group(1)), []).append((time, numbers))
    return found


def read_rbdout(path):
    """{part: [{"t": .., "coordinates": [x, y, z], "velocities": [x, y, z, x-rot, y-rot, z-rot], ...}, ...]}, global axes."""
    found, time, body = {}, None, None
    with open(path) as file:
        for line in file:
            if "r i g i d   b o d y" in line:
                time, body = float(line.split("time=")[1]), None
            elif begins := re.match(r"\s*(?:nodal )?rigid body\s*(\d+)", line):
                body = {"t": time}
                found.setdefault(int(begins.group(1)), []).append(body)
            elif body is not None and (row := re.match(r"\s*(\w+):(.*)", line)) and row.group(1) not in body:
                body[row.group(1)] = [float(value) for value in re.findall(NUMBER, row.group(2))]
    return found


READERS = {
    "matsum": lambda path: read_labelled(path, " time =", r" (mat)\.#=\s*(\d+)"),
    "rcforc": read_rcforc,
    "sleout": lambda path: read_rows(path, "contact interface energy", "time=", r"\s+(\d+)(?=\s+[-\d.])"),
    "nodout": read_nodout,
    "rbdout": read_rbdout,
    "bndout": lambda path: read_labelled(path, "n o d a l   f o r c e", r"\s*(nd|mat)#\s*(\d+)"),
    "spcforc": lambda path: read_rows(path, "output at time", "time =", r" node=\s*(\d+) local x,y,z forces ="),
    "sphout": lambda path: read_rows(path, "S P H   o u t p u t", "at time", r"\s*(\d+)\s+\d+(?=\s+-?\d\.)"),
}


def read_history(path):
    """All datasets of history.h5 by name, and their dimensions in mass, length, time."""
    import h5py
    values, dimensions = {}, {}
    with h5py.File(path) as h5:
        def note(name, item):
            if isinstance(item, h5py.Dataset):
                values[name] = item[:]
                text = item.attrs["dimension"]
                dimensions[name] = text.decode() if isinstance(text, bytes) else str(text)
        h5.visititems(note)
    return values, dimensions


def main():
    results = sys.argv[1] if len(sys.argv) > 1 else "."
    glstat = read_glstat(os.path.join(results, "glstat"))
    values, dimensions = read_history(os.path.join(results, "history.h5"))
    if len(sys.argv) < 3:
        print(f"glstat, {len(glstat['time'])} times: " + ", ".join(glstat))
        for name, read in READERS.items():
            path = os.path.join(results, name)
            if os.path.exists(path):
                for owner, rows in read(path).items():
                    print(f"{name} of {owner}, {len(rows)} rows, the last one: {rows[-1]}")
        for name, column in values.items():
            print(f"{name:40} {str(column.shape):16} {dimensions[name]}")
        return
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    for label in ("kinetic energy", "internal energy", "external work", "total energy"):
        pyplot.plot(glstat["time"], glstat[label], label=label)
    pyplot.plot(values["global/time"], values["global/dissipated"], "--", label="dissipated (history.h5)")
    pyplot.xlabel("time")
    pyplot.ylabel("energy")
    pyplot.legend()
    pyplot.savefig(sys.argv[2], dpi=120)


if __name__ == "__main__":
    main()
