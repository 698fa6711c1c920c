"""What the scripts beside this share: bounds that are reported as they are looked at, and runs in folders of their own."""
import os
import subprocess

failures = []


def bound(what, value, low, high):
    text = f"{what}: {value:.6g}, from {low:g} to {high:g}"
    print(("ok      " if low <= value <= high else "FAILED  ") + text)
    if not low <= value <= high:
        failures.append(text)


def run_deck(courant, text, folder, threads=1, may_fail=False):
    """Runs a deck in a new folder; returns the folder of its results. `may_fail`: any exit code is right, as long as there is a summary."""
    os.makedirs(folder)
    path, out = os.path.join(folder, "deck.k"), os.path.join(folder, "out")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([courant, "run", path, "-o", out, "--threads", str(threads), "--quiet"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, cwd=folder, text=True)
    if done.returncode != 0 and not (may_fail and os.path.exists(os.path.join(out, "summary.yaml"))):
        raise SystemExit(f"{path}: exit code {done.returncode}: {done.stdout[-1000:]}")
    return out
