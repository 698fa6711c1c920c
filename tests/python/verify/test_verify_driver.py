"""`courant verify` end to end with a solver that solves nothing."""

from __future__ import annotations

import csv
import io
import os
import signal
import subprocess
import sys
import time
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np
import pytest
from made_results import write_history

from courant.verify import cli, take

HERE = Path(__file__).resolve().parent
SUITE = """
cases:
  - name: growth
    scene: scene.yaml
    resolution: n
    resolutions: [10, 20, 40]
    size: 1 / n
    settings: [{name: plain}, {name: other, parameters: {how: MORE}}]
    observations:
      - {name: final, of: global/kinetic, take: final, reference: t, bound: 0.001, least_order: 1.9}
      - {name: curve, of: global/kinetic, reference: t^2}
"""


@pytest.fixture(scope="module")
def histories(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Those that the made solver copies: an interpreter with numpy and h5py for each of its runs takes most of the time."""
    out, t = tmp_path_factory.mktemp("histories"), np.linspace(0, 1, 11)
    for n in (10, 20, 40):
        write_history(out / f"{n}.h5", {"/global/time": t, "/global/kinetic": t**2 * (1 + 1 / n**2)})
    return out


class Caller:
    """Calls in a folder of their own."""

    def __init__(self, folder: Path, histories: Path) -> None:
        self.folder = folder
        (folder / "scene.yaml").write_text("parameters: {n: 10, how: 0, seconds: 0.5}\n")
        self.write(SUITE)
        self.environment = dict(
            os.environ,
            COUNT=str(folder / "count"),
            HISTORIES=str(histories),
            COURANT_EXECUTABLE=str(HERE / "fake_courant.py"),
            PYTHONPATH=str(HERE.parents[2] / "src" / "python"),
        )

    def write(self, text: str, how: str = "1") -> None:
        """`how` is no number to the scene's parameters where it is a word: suites of decks take it as it is."""
        (self.folder / "suite.yaml").write_text(text.replace("MORE", how))

    def words(self, *more: str) -> list[str]:
        return [sys.executable, "-c", "import sys; from courant.verify.cli import main; sys.exit(main(sys.argv[1:]))", "suite.yaml", *more]

    def __call__(self, *more: str, code: int = 0, reports: bool = False) -> str:
        """A call in this process; charts take longest, and are written where they are looked at."""
        out, handlers = io.StringIO(), [(number, signal.getsignal(number)) for number in (signal.SIGINT, signal.SIGTERM)]
        with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(out):
            patch.chdir(self.folder)
            for name, value in self.environment.items():
                patch.setenv(name, value)
            if not reports:
                patch.setattr(cli, "write_reports", lambda *_: None)
            try:
                ended = cli.main(["suite.yaml", *more])
            except SystemExit as end:  # of wrong words
                ended = int(str(end.code))
            for number, handler in handlers:
                signal.signal(number, handler)
        assert ended == code, out.getvalue()
        return out.getvalue()

    def runs(self) -> int:
        """How many there were since the last question."""
        count = self.folder / "count"
        lines = count.read_text().splitlines() if count.exists() else []
        count.unlink(missing_ok=True)
        return len(lines)

    def rows(self) -> list[dict[str, str]]:
        with open(self.folder / "suite_verify" / "results.csv", newline="") as file:
            return list(csv.DictReader(file))


@pytest.fixture
def call(tmp_path: Path, histories: Path) -> Caller:
    return Caller(tmp_path, histories)


def test_runs_are_judged_and_taken_over(call: Caller) -> None:
    said = call("--page", "page.md", reports=True)
    assert "4 of 4 checks met, 0 missed" in said and "[6/6] growth" in said
    assert call.runs() == 6
    errors = [float(row["error"]) for row in call.rows() if row["setting"] == "plain" and row["observation"] == "final"]
    assert errors == pytest.approx([1e-2, 2.5e-3, 6.25e-4])
    assert (call.folder / "page" / "growth-final-error.svg").is_file() and (call.folder / "suite_verify" / "report.html").is_file()
    assert "6 of 6 runs are taken over" in call()
    assert call.runs() == 0
    (call.folder / "suite_verify" / "runs" / "growth" / "plain-20" / "record.yaml").unlink()
    assert "5 of 6 runs are taken over" in call()
    assert call.runs() == 1
    call("--fresh")
    assert call.runs() == 6


def test_an_edited_scene_that_makes_the_same_decks_keeps_its_runs(call: Caller) -> None:
    call()
    (call.folder / "scene.yaml").write_text("# the same\nparameters: {n: 10, how: 0, seconds: 0.5}\n")
    assert "6 of 6 runs are taken over" in call()
    deck = call.folder / "suite_verify" / "runs" / "growth" / "plain-20" / "deck.k"
    written = deck.read_text()
    deck.write_text(written.replace("n=20", "n=2"))
    call.runs()
    assert "6 of 6 runs are taken over" in call()
    assert (deck.read_text(), call.runs()) == (written, 0), "a deck that somebody has changed is written anew"
    call.environment["COURANT_SIMD"] = "other"
    call.runs()
    call()
    assert call.runs() == 6, "another build"


def test_missed_bounds_and_earlier_results(call: Caller) -> None:
    call()
    (call.folder / "suite_verify" / "results.csv").rename(call.folder / "old.csv")
    call.write(SUITE.replace("bound: 0.001", "bound: 1.0e-5"))
    assert "MISSED  growth: plain, final: error at most 0.001 %, measured 0.063 %" in call(code=2)
    assert "WORSE  growth: plain, 40, final: check missed, was met" in call("--compare", "old.csv", code=2)
    assert "nothing has changed" in call("--compare", "suite_verify/results.csv"), "what was missed before does not fail a comparison"
    assert "none.csv: error: cannot read the earlier results" in call("--compare", "none.csv", code=1)


DECK = "cases:\n  - name: one\n    deck: deck.k\n    time_limit: LIMIT\n    parameters: {how: MORE}\n    observations: [{name: k, of: global/kinetic, take: max}]\n"


@pytest.mark.parametrize(
    ("how", "said"),
    [
        ("refused", "default: refused: deck.k:1:1: error: no such keyword"),
        ("crashes", "default: broken: ended by signal 11 (Segmentation fault)"),
        ("hangs", "default: broken: ran longer than 0.3 s"),
    ],
)
def test_how_runs_end(call: Caller, how: str, said: str) -> None:
    (call.folder / "deck.k").write_text("*KEYWORD\n")
    call.write(DECK.replace("LIMIT", "0.3" if how == "hangs" else "60"), how)
    out = call(code=2)
    assert said in out and "MISSED  one: default: runs to its end" in out
    if how == "hangs":
        call.runs()
        call(code=2)
        assert call.runs() == 0, "it would be ended again"
        call.write(DECK.replace("LIMIT", "3"), how)
        call(code=2)
        assert call.runs() == 1, "with more time it may come to its end"


def test_faults_leave_nothing_behind(call: Caller) -> None:
    call.write(SUITE.replace("how: MORE", "how: 1, seconds: odd"))
    assert "nothing was run" in call(code=1)
    call.write(SUITE.replace("take: final", "take: finl"))
    assert "did you mean final?" in call(code=1)
    call.environment["COURANT_EXECUTABLE"] = "/nowhere/courant"
    call.write(SUITE)
    assert "the program '/nowhere/courant' cannot be started" in call(code=1)
    assert not (call.folder / "suite_verify").exists()
    assert "no case 'growht'\n  hint: did you mean growth?" in call("--only", "growht", code=1)
    call("--jobs", "-1", code=1)
    call("--nonsense", code=1)


def test_faults_of_generate_are_told_at_the_case(call: Caller) -> None:
    (call.folder / "scene.yaml").write_text("parameters: {n: 10, how: 0, odd: 1}\n")
    call.write(SUITE, "odd")
    said = call(code=1)
    assert "suite.yaml:3:5: error: case growth, other, n = 10: scene.yaml:2:3: error: how: it is odd\n  hint: be even\n" in said
    assert "3 errors; nothing was run" in said


def test_folders_of_others_are_left_alone(call: Caller) -> None:
    (call.folder / "out" / "runs").mkdir(parents=True)
    assert "the folder holds something else called 'runs'" in call("-o", "out", code=1)
    (call.folder / "file").write_text("")
    assert "cannot write 'file" in call("-o", "file/below", code=3)


def test_interrupted_and_killed_calls_go_on(call: Caller) -> None:
    (call.folder / "deck.k").write_text("*KEYWORD\n")
    call.write(DECK.replace("time_limit: LIMIT", "resolution: seconds\n    resolutions: [0.01, 0.02, 20]"), "slow")
    for signal_number, code in ((signal.SIGINT, 2), (signal.SIGKILL, -9)):
        process = subprocess.Popen(
            call.words("--jobs", "1", "--fresh"), cwd=call.folder, env=call.environment, stdout=subprocess.PIPE, text=True
        )
        assert process.stdout is not None
        while not process.stdout.readline().startswith("[2/3]"):
            assert process.poll() is None
        time.sleep(0.2)
        assert "another `courant verify` works in this folder" in call(code=1)
        children = subprocess.run(
            ["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True, check=True
        ).stdout.split()
        process.send_signal(signal_number)
        process.communicate(timeout=20)
        assert process.returncode == code
        end = time.monotonic() + 10
        while any(Path("/proc", pid).exists() for pid in children) and time.monotonic() < end:
            time.sleep(0.02)
        assert children and not any(Path("/proc", pid).exists() for pid in children), "children end with the call"
    call.write(DECK.replace("time_limit: LIMIT", "resolution: seconds\n    resolutions: [0.01, 0.02, 0.03]"), "slow")
    assert "2 of 3 runs are taken over" in call()


def test_functions_of_ones_own(call: Caller, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(take, "functions", dict(take.functions))  # what is added here is not there for other tests
    (call.folder / "mine.py").write_text(
        "from courant.verify import take\n\n\n@take('spread')\ndef spread(series, at):\n    return float(series.y.max() - series.y.min())\n"
    )
    call.write(SUITE.replace("take: final", "take: spread").replace("reference: t,", "reference: '1',"))
    assert "cannot be 'spread'" in call(code=1)
    assert "4 of 4 checks met" in call("--load", "mine.py")
    (call.folder / "bad.py").write_text("from courant.verify import take\ntake('final')(print)\n")
    assert "error: --load: 'bad.py': ValueError: there is a take 'final' already" in call("--load", "bad.py", code=1)


def test_a_missing_module_is_told_before_anything_is_run(call: Caller) -> None:
    (call.folder / "jinja2.py").write_text("raise ModuleNotFoundError('none', name='jinja2')\n")
    call.environment["PYTHONPATH"] += f":{call.folder}"
    words = call.words()
    words[2] = f"import sys; sys.path.insert(0, {str(call.folder)!r}); " + words[2]
    done = subprocess.run(words, cwd=call.folder, env=call.environment, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 3
    assert done.stderr == "error: the Python module 'jinja2' is missing: apt-get install python3-jinja2\n"
    assert call.runs() == 0


def test_settings_add_cards_to_decks_of_scenes(call: Caller) -> None:
    call.write(SUITE.replace("{how: MORE}}", "{how: MORE}, keywords: \"*CARD\\nhow=slow\"}"))
    call()
    call.runs()
    decks = [path.read_text() for path in sorted(call.folder.glob("suite_verify/runs/growth/*-10/deck.k"))]
    assert sorted("*CARD\nhow=slow\n*END\n" in deck for deck in decks) == [False, True]
    call()
    assert call.runs() == 0
    call.write(SUITE.replace("{how: MORE}}", "{how: MORE}, keywords: \"*CARD\\nhow=well\"}"))
    call()
    assert call.runs() == 3, "other cards are another deck"
    call.write("cases: [{name: a, deck: deck.k, settings: [{name: b, keywords: '*CARD'}]}]")
    (call.folder / "deck.k").write_text("*END\n")
    assert "'keywords' belong to a case with a 'scene' or 'build'" in call(code=1)


BUILDER = '''
def deck(n=10, how=0, seconds=0.5, word="a"):
    """As the scene of the other tests makes it."""
    return f"*KEYWORD\\nn={n}\\nhow={how}\\nseconds={seconds}\\nword={word}\\n*END\\n"
def wrong(n=10):
    return 1 / 0
def bare(n):
    return ""
'''


def test_decks_are_built_by_functions(call: Caller) -> None:
    (call.folder / "decks.py").write_text(BUILDER)
    call.write(SUITE.replace("scene: scene.yaml", "build: decks.py:deck").replace("{how: MORE}", "{how: 2 * 0.5, word: b}"))
    call()
    assert call.runs() == 6
    decks = [path.read_text() for path in sorted(call.folder.glob("suite_verify/runs/growth/*-20/deck.k"))]
    assert sorted(("word=a" in deck, "n=20" in deck) for deck in decks) == [(False, True), (True, True)]
    call()
    assert call.runs() == 0, "the same decks"
    (call.folder / "decks.py").write_text(BUILDER.replace("word={word}", "other={word}"))
    call()
    assert call.runs() == 6, "the function makes other decks"


@pytest.mark.parametrize(("build", "what"), [("none.py:deck", "a file that is there"), ("decks.py", "expected FILE.py:FUNCTION"), ("decks.py:none", "has no function 'none'"),
                                             ("decks.py:wrong", "wrong: ZeroDivisionError"), ("decks.py:bare", "'n' of bare has no default"),
                                             ("decks.py:deck", "deck has no parameter 'm': it has n, how")])
def test_builders_that_cannot_be_called_are_named(call: Caller, build: str, what: str) -> None:
    (call.folder / "decks.py").write_text(BUILDER)
    more = ", parameters: {m: 1}" if "no parameter" in what else ""
    call.write(f"cases: [{{name: a, build: '{build}'{more}, observations: [{{name: b, of: global/kinetic, take: final}}]}}]")
    assert what in call(code=1) and call.runs() == 0


def test_a_builder_that_returns_nothing_is_named(call: Caller) -> None:
    (call.folder / "decks.py").write_text("def deck(n=1):\n    pass\n")
    call.write("cases: [{name: a, build: 'decks.py:deck', observations: [{name: b, of: global/kinetic, take: final}]}]")
    assert "deck gives NoneType, expected the text of a deck" in call(code=1)
