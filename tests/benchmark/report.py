#!/usr/bin/env python3
"""Runs the benchmarks and makes the tables of docs/benchmarks.md of them.

usage: report.py BUILD_FOLDER [--full | --smoke] [--write] [--json FILE]

Takes one to two minutes. Prints the tables; --write puts them between the two marker lines of docs/benchmarks.md
instead. --full adds the scenes that take many minutes and gigabytes, --smoke runs small ones for a few steps to see that
all works. --json takes what an earlier run of the program wrote, without running it:
benchmarks --benchmark_out=FILE --benchmark_out_format=json.
"""
import argparse
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parents[2]
PAGE = PROJECT / "docs" / "benchmarks.md"
BEGIN, END = "<!-- benchmarks: begin -->", "<!-- benchmarks: end -->"
SETS = ("baseline", "avx2", "avx512")


def run(program, options):
    """What Google Benchmark writes."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.json"
        done = subprocess.run([program, *options, f"--benchmark_out={out}", "--benchmark_out_format=json"],
                              stdout=subprocess.DEVNULL)
        if done.returncode != 0:
            sys.exit(f"{program} ended with {done.returncode}")
        return json.loads(out.read_text())


def by_group(result):
    """{"step": {"dam 2D 5k": counters}, ...}; names are GROUP/NAME/iterations:1/manual_time."""
    groups = {}
    for entry in result["benchmarks"]:
        if entry.get("error_occurred"):
            sys.exit(f"{entry['name']}: {entry.get('error_message')}")
        group, name = entry["name"].split("/iterations:")[0].split("/", 1)
        groups.setdefault(group, {})[name] = entry
    return groups


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def number(value):
    """Three digits, thousands apart."""
    if value == 0:
        return "0"
    digits = 0 if abs(value) >= 100 else 1 if abs(value) >= 10 else 2
    return f"{value:,.{digits}f}".replace(",", " ")


def percent(value):
    return f"{100 * value:.0f}"


def machine(groups):
    rows = []
    for kind in SETS:
        if f"{kind}/1" in groups["peak"]:
            one, two = (groups["peak"][f"{kind}/{t}"]["flops"] / 1e9 for t in (1, 2))
            rows.append([f"arithmetic, {kind}, Gflop/s", number(one), number(two)])
    one, two = (groups["triad"][str(t)]["bytes"] / 1e9 for t in (1, 2))
    rows.append(["memory, triad, GB/s", number(one), number(two)])
    return table(["limit", "1 thread", "2 threads"], rows)


def named(steps, start):
    return [(name, c) for name, c in steps.items() if name.split()[0] in start]


def costs(scenes):
    rows = []
    for name, c in scenes:
        rows.append([name, number(c["active"]), number(c["pairs"]), number(c["entries"]),
                     number(c["steps"] / c["rebuilds"]) if c["rebuilds"] else "-",
                     number(c["wall_ns_1"]), number(c["cpu_ns_1"]), number(c["wall_ns_2"]), number(2 * c["wall_ns_2"]),
                     percent(c["wall_ns_1"] / (2 * c["wall_ns_2"])), number(c["cpu_ns_1"] / c["pairs"])])
    return table(["scene", "active", "pairs", "lanes", "steps per rebuild", "ns, 1 thread", "processor ns", "ns, 2 threads",
                  "x 2", "efficiency, %", "ns per pair"], rows)


def passes(scenes):
    """Passes as rows; what is under 1 % everywhere goes into the rest."""
    names = []
    for _, c in scenes:
        names += [key[5:] for key in c if key.startswith("pass ") and key[5:] not in names]
    share = {n: [c.get("pass " + n, 0) for _, c in scenes] for n in names}
    shown = sorted((n for n in names if max(share[n]) >= 0.01), key=lambda n: -max(share[n]))
    rows = [[n, *(percent(s) for s in share[n])] for n in shown]
    rows.append(["the rest", *(percent(1 - sum(share[n][k] for n in shown)) for k in range(len(scenes)))])
    return table(["pass", *(name for name, _ in scenes)], rows)


def memory(scenes):
    return table(["scene", "fields", "lists", "kept gradients", "sum"],
                 [[name, number(c["field_bytes"]), number(c["list_bytes"]), number(c["kept_bytes"]),
                   number(c["field_bytes"] + c["list_bytes"] + c["kept_bytes"])] for name, c in scenes])


def roofline(scenes, peak, bandwidth, cache):
    """One thread: what arithmetic and memory alone would take, beside what was measured. Memory bounds what the caches
    do not hold."""
    rows = []
    for name, c in scenes:
        arithmetic, ns = 1e9 * c["flops"] / peak, c["cpu_ns_1"]
        useful = 1e9 * c["useful_flops"] / peak
        in_cache = c["active"] * (c["field_bytes"] + c["list_bytes"] + c["kept_bytes"]) <= cache
        stream = 0 if in_cache else 1e9 * c["bytes_streamed"] / bandwidth
        rows.append([name, number(c["flops"]), number(c["flops"] / ns), number(useful), number(arithmetic),
                     number(c["bytes_streamed"]), number(c["bytes_streamed"] / ns), "-" if in_cache else number(stream),
                     number(ns), f"{ns / max(arithmetic, stream):.2f}"])
    return table(["scene", "flop", "Gflop/s", "ns at peak, pairs only", "ns at peak, all lanes", "bytes", "GB/s",
                  "ns at triad", "measured ns", "measured / larger bound"], rows)


def pair_loops(groups, peaks):
    rows = []
    for name, c in groups.get("pairs", {}).items():
        for run in peaks:
            for how in ("kept", "again"):
                if f"{run} {how} rates_ns" not in c:
                    continue
                rates, forces, flops = c[f"{run} {how} rates_ns"], c[f"{run} {how} forces_ns"], c[f"flops {how}"]
                rate = flops / (rates + forces)
                rows.append([f"block {name}", number(c["active"]), *run.split("/"), how, number(rates), number(forces),
                             number(rates + forces), number(flops), number(rate), percent(1e9 * rate / peaks[run])])
    return table(["particles", "number", "instructions", "threads", "gradients", "rates, ns", "forces, ns", "both", "flop",
                  "Gflop/s", "% of peak"], rows)


def sets(steps):
    rows = [(name.split()[1], c) for name, c in named(steps, ["set"])]
    first = rows[0][1]["cpu_ns_1"]
    return table(["instructions", "processor ns", "gain", "pair loops, %"],
                 [[name, number(c["cpu_ns_1"]), f"{first / c['cpu_ns_1']:.2f}",
                   percent(c["pass sph rates"] + c["pass sph forces"])] for name, c in rows])


def sizes(steps):
    blocks = [c for _, c in named(steps, ["block"])]
    rows = []
    for c in sorted(blocks, key=lambda c: (c["dim"], c["active"])):
        rows.append([f"{c['dim']:.0f}D", number(c["active"]), number(c["pairs"]), "kept" if c["kept"] else "again",
                     number(c["cpu_ns_1"]), number(c["wall_ns_1"]), number(c["wall_ns_2"]),
                     number(1e3 / c["wall_ns_2"]), number(c["cpu_ns_1"] / c["pairs"])])
    return table(["", "particles", "pairs", "gradients", "processor ns", "ns, 1 thread", "ns, 2 threads",
                  "million particle-steps/s, 2 threads", "ns per pair"], rows)


def processor_name():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines() if os.path.exists("/proc/cpuinfo") else []:
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def report(result, load_after):
    groups, context = by_group(result), result["context"]
    steps = groups["step"]
    scenes = named(steps, ["jump", "dam"])
    large = [(name, c) for name, c in named(steps, ["block"]) if c["active"] >= 1e6]
    peaks = {run: c["flops"] for run, c in groups["peak"].items()}  # of "avx2/1", ...
    best = context["instruction_set"]
    cache = max((c["size"] for c in context["caches"]), default=0)
    alone = min(groups["peak"][run.replace("/1", "/2")]["flops"] / peaks[run] for run in peaks if run.endswith("/1")) > 1.8
    warning = "" if alone else " **Others held the second core for long: what follows for 2 threads is not to be trusted.**"
    load = f"{context['load_avg'][0]:.1f} at the start" + "".join(f", {x:.1f} at the end" for x in load_after)
    return f"""{processor_name()}, {context['num_cpus']} cores, {best}; load {load}.{warning}

The machine, measured by chains of FMAs and by a triad beyond the caches:

{machine(groups)}

Cost per active particle and step. Pairs: neighbours within 2h; lanes: eight for each entry in reach of its group, in each of the two pair loops. ns are
wall time on 1 and on 2 threads, the quickest of several chunks; processor ns the least processor time on 1 thread, which load
from others disturbs less. Efficiency: 1 thread / (2 x 2 threads), meaningless where others take the second core. ns per pair:
of processor ns.

{costs(scenes)}

Where the time goes on 1 thread, % (neighbours: rebuilding the lists, and checking whether they still hold):

{passes(scenes)}

Bytes per active particle:

{memory(scenes)}

Against the limits of the machine, 1 thread, per particle and step. Operations and bytes are counted from the source
(`tests/benchmark/work.hpp`); "pairs only" leaves out lanes beyond 2h. The triad bounds only what does not fit into the caches
({cache / 2**20:.0f} MiB).

{roofline(scenes + large, peaks[best + "/1"], groups["triad"]["1"]["bytes"], cache)}

The two pair loops alone, ns of wall time per particle, gradients kept from the rates for the forces or worked out again:

{pair_loops(groups, peaks)}

A whole step with each instruction set, dam 2D 5k, 1 thread:

{sets(steps)}

Cost against size, blocks of water without walls that fly at 1/50 of the speed of sound:

{sizes(steps)}
"""


def write(text):
    page = PAGE.read_text()
    if page.count(BEGIN) != 1 or page.count(END) != 1 or page.index(BEGIN) > page.index(END):
        sys.exit(f"{PAGE}: needs the lines {BEGIN} and {END}, once each")
    before, rest = page.split(BEGIN)
    PAGE.write_text(f"{before}{BEGIN}\n\n{text}\n{END}{rest.split(END)[1]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--full", action="store_true")
    size.add_argument("--smoke", action="store_true")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--json", type=pathlib.Path)
    given = parser.parse_args()
    if given.smoke and given.write:
        parser.error("a few steps are no measurement: --smoke is not for writing")
    if given.json:
        result, load_after = json.loads(given.json.read_text()), []
    else:
        options = ["--full"] * given.full + ["--smoke"] * given.smoke
        result = run(given.build / "tests" / "benchmark" / "benchmarks", options)
        load_after = [os.getloadavg()[0]]
    text = report(result, load_after)
    if given.write:
        write(text)
    else:
        print(text)


if __name__ == "__main__":
    main()
