"""Numbers, times, tables, machine and revision as the pages write them."""
import math
import os
import pathlib
import platform
import subprocess
import time


def number(value, form="{:.3g}"):
    """A number for a cell; a dash where there is none."""
    if value is None:
        return "-"
    value = float(value)
    return "-" if math.isnan(value) or math.isinf(value) else form.format(value)


def percent(value, digits=1):
    return number(value, "{:.%df} %%" % digits) if value is None else number(100 * float(value), "{:.%df} %%" % digits)


def hours(seconds):
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def table(head, rows):
    if any(len(row) != len(head) for row in rows):
        raise ValueError(f"a row of the table of '{head[0]}' has not the {len(head)} cells of its head")
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def machine():
    """Processor, cores, memory and system of this computer, as far as it tells."""
    processor, memory, system = platform.machine(), "", platform.system()
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines() if pathlib.Path("/proc/cpuinfo").exists() else []:
        if line.startswith("model name"):
            processor = line.split(":", 1)[1].strip()
            break
    try:
        for line in pathlib.Path("/proc/meminfo").read_text().splitlines():
            if line.startswith("MemTotal"):
                memory = f", {float(line.split()[1]) / 2**20:.0f} GiB"
        system = platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, AttributeError, KeyError):
        pass
    return f"{processor}, {os.cpu_count()} cores{memory}, {system}"


def revision(project):
    """The commit of the source, with a + where files differ from it; nothing outside a repository."""
    def git(*words):
        return subprocess.run(["git", "-C", project, *words], capture_output=True, text=True, check=True).stdout.strip()
    try:
        return ", commit " + git("rev-parse", "--short=10", "HEAD") + ("+" if git("status", "--porcelain", "--untracked-files=no", "src") else "")
    except (OSError, subprocess.CalledProcessError):
        return ""


def heading(title, command, about, cut, program, project, old):
    """Top of a page: how it was made, and what it is about; a trial is told where `cut` [s] is not None, as are runs of an earlier build."""
    version = subprocess.run([program.courant, "--version"], capture_output=True, text=True).stdout.partition("\n")[0] or "courant"
    text = f"# {title}\n\nWritten by `{command}` on {time.strftime('%Y-%m-%d')}; do not edit, run it again. {version}{revision(project)}, on {machine()}. {about}\n"
    if cut is not None:
        text += f"\n**A quick trial: every run was cut to {cut:g} s. These numbers mean nothing.**\n"
    if old:
        text += f"\nRun or evaluated by an earlier build: {', '.join(old)}.\n"
    return text
