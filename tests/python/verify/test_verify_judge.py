"""Orders, bounds, verdicts, records of runs, and what changed since an earlier call."""

from __future__ import annotations

import copy
import csv
import math
import re
import random
from pathlib import Path

import pytest
import yaml
from made_suite import stability, suite, whole_suite

from courant.diagnostics import Diagnostics
from courant.files import OutputError
from courant.verify.changes import Comparison, compare_with
from courant.verify.digest import digest_of_deck
from courant.verify.judge import check_bounds, judge_stability, measured_orders
from courant.verify.model import (
    Case,
    CaseResult,
    Limit,
    Observation,
    Observed,
    Reference,
    RunNumbers,
    RunResult,
    Setting,
    Stability,
    Suite,
    SuiteResult,
    Verdict,
)
from courant.verify.record import RunRecord, read_record, result_of_run, says_something_of_the_deck, write_record
from courant.verify.result_files import results_csv, results_yaml
from courant.verify.schedule import RunSchedule, duration_text
from courant.verify.terminal import case_table, checks_text


def made_case() -> CaseResult:
    """Errors 0.4 dx^2 at dx = 0.1, 0.05, 0.025 for setting a, none at the finest of setting b."""
    c = CaseResult(
        Case(
            "wave",
            resolution="n",
            size="dx",
            settings=[Setting("a"), Setting("b")],
            observations=[Observation("height", reference=Reference("formula"))],
        )
    )
    for setting in "ab":
        for k in range(3):
            run = RunResult(setting, str(10 << k), size=0.1 / (1 << k), cpu_seconds=1, particle_steps=1000000)
            run.observed = [Observed("height", True, error=0.4 * run.size**2)]
            c.runs.append(run)
    c.runs[-1].observed[0].error = None
    return c


def judge(c: CaseResult) -> CaseResult:
    c.orders = measured_orders(c.definition, c.runs)
    c.checks = check_bounds(c.definition, c.runs, c.orders)
    return c


def test_orders_and_bounds() -> None:
    c = made_case()
    o = c.definition.observations[0]
    o.bound, o.least_order = 0.4 * 0.025**2 * 1.001, 1.9
    judge(c)
    assert [m.order for m in c.orders] == pytest.approx([2, 2]), "of b, of the two runs that have an error"
    assert [check.met for check in c.checks] == [True, True, False, True], "no error at the finest resolution is a missed bound"
    assert math.isnan(c.checks[2].measured)
    o.bound_settings = ["a"]
    assert len(judge(c).checks) == 2
    o.least_order = 2.1
    assert not judge(c).checks[1].met
    c.runs[0].verdict = Verdict.stopped
    assert (judge(c).checks[0].what, c.checks[0].met) == ("n = 10 runs to its end", False)
    c.runs[1].observed[0] = Observed("height", True, "the reference is 0")
    assert judge(c).checks[1].what == "an error to compare: the reference is 0"


def test_bound_against_the_finest_run() -> None:
    c = made_case()
    c.definition.settings.pop()
    c.runs = c.runs[:3]
    c.runs[2].observed[0].error = None
    c.definition.observations[0].reference.kind, c.definition.observations[0].bound = "finest", 0.4 * 0.05**2 * 1.001
    assert [check.met for check in judge(c).checks] == [True]


def test_verdicts_of_stability() -> None:
    limits = [Limit("residual", "residual", "0.01"), Limit("growth", "growth / 2", "1"), Limit("depth", "penetration", "0.1")]
    asked = Stability(limits=limits, must_be_stable="1 - c0", must_stop="c0 - 10")
    growth = Observed("growth", True, value=1.5)

    def judged(c0: float, ended: Verdict, **changed: float) -> RunResult:
        numbers = RunNumbers(**{"residual": 0.001, "ratio": 1, "leaked": 0, "penetration": 0.04, "steps": 10, **changed})
        run = RunResult(verdict=ended, observed=[growth], numbers=numbers)
        check = judge_stability(asked, {"c0": c0, "dx": 0.5}, run)
        assert check.met == run.as_required
        return run

    good = judged(0, Verdict.stable)
    assert (good.verdict, good.as_required) == (Verdict.stable, True)
    deep = judged(0, Verdict.stable, penetration=0.06)  # 0.12 spacings
    assert (deep.exceeded, deep.verdict, deep.as_required) == (["depth = 0.12 > 0.1"], Verdict.degraded, False)
    assert judged(5, Verdict.stable, penetration=0.06).as_required, "nothing is required there"
    required = [
        judged(5, Verdict.stopped),
        judged(5, Verdict.broken),
        judged(0, Verdict.stopped),
        judged(20, Verdict.stable),
        judged(20, Verdict.refused),
    ]
    assert [run.as_required for run in required] == [True, False, False, False, True]
    assert judged(0, Verdict.stable, residual=math.nan).verdict == Verdict.degraded, "no number is no pass"
    growth.found, growth.value, growth.why = False, None, "no peaks"
    assert judged(0, Verdict.stable).exceeded[0] == "growth = nan > 1 (growth: no peaks)"
    asked.must_stop = "1 / c0"
    assert not judged(0, Verdict.stable).as_required


SUMMARY = "termination: normal\nreason: done\nsteps: 5\nenergy: {total: %s, ratio: 1}\n"


@pytest.mark.parametrize(
    ("record", "files", "verdict", "reason"),
    [
        ({}, {}, "broken", "exit code 0, but there is no summary.yaml"),
        ({"exit_code": 3}, {}, "broken", "exit code 3"),
        ({"exit_code": 2}, {}, "broken", "stopped without a reason (exit code 2)"),
        ({"exit_code": 1}, {}, "broken", "refused without a reason (exit code 1)"),
        (
            {"exit_code": 1},
            {"errors.txt": "deck.k:3: warning: x\ndeck.k:4:1: error: no such thing\n"},
            "refused",
            "deck.k:4:1: error: no such thing",
        ),
        ({"exit_code": -1, "signal": 11}, {}, "broken", "ended by signal 11 (Segmentation fault)"),
        ({"timed_out": True, "time_limit": 2.5}, {}, "broken", "ran longer than 2.5 s"),
        ({}, {"summary.yaml": SUMMARY % ".nan"}, "broken", "it ended normally, but its energy is not finite"),
        ({}, {"summary.yaml": SUMMARY % "1.5"}, "stable", "done"),
        ({}, {"summary.yaml": "termination: error\nreason: odd\n"}, "broken", "exit code 0 with the termination 'error': odd"),
        ({"exit_code": 2}, {"summary.yaml": "termination: error\nreason: NaN at t = 1\nenergy: {total: 1.5}\n"}, "stopped", "NaN at t = 1"),
        (
            {"exit_code": 2},
            {"summary.yaml": SUMMARY % "1" + "verdict: broken\nverdict_reasons: [it leaks]\n"},
            "degraded",
            "its results cannot be trusted: it leaks",
        ),
    ],
)
def test_how_a_run_ended(tmp_path: Path, record: dict, files: dict[str, str], verdict: str, reason: str) -> None:
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    result = result_of_run(tmp_path, RunRecord("k", **record))
    assert (result.verdict.name, result.reason) == (verdict, reason)


def test_numbers_of_a_summary(tmp_path: Path) -> None:
    (tmp_path / "summary.yaml").write_text(
        "termination: normal\nsteps: 5\nleaked_particles: 2\nmax_penetration: 1e-3\n"
        "energy: {total: 1.5, ratio: 1, residual: -0.5, error: -0.125, throughput: 2}\n"
    )
    numbers = result_of_run(tmp_path, RunRecord("k")).numbers
    assert numbers == RunNumbers(residual=0.25, error=0.125, ratio=1, leaked=2, penetration=1e-3, steps=5)


def test_records_are_kept_whole(tmp_path: Path) -> None:
    record = RunRecord("abc", scene="def", exit_code=2, timed_out=True, wall_seconds=1.25)
    write_record(tmp_path, record)
    assert read_record(tmp_path) == record
    chance = random.Random(5)
    whole = (tmp_path / "record.yaml").read_bytes()
    for _ in range(200):
        data = bytearray(whole)
        for _ in range(3):
            data[chance.randrange(len(data))] = chance.randrange(256)
        for name in ("record.yaml", "summary.yaml"):
            (tmp_path / name).write_bytes(bytes(data))
        found = read_record(tmp_path)
        result_of_run(tmp_path, found or RunRecord())
        assert found is None or isinstance(found.exit_code, int)
    (tmp_path / "record.yaml").write_text("key: [")
    assert read_record(tmp_path) is None


def test_faults_of_the_machine_say_nothing_of_the_deck(tmp_path: Path) -> None:
    good = SUMMARY % "1.5"

    def says(summary: str, **record: object) -> bool:
        (tmp_path / "summary.yaml").write_text(summary)
        one = RunRecord(**record)  # type: ignore[arg-type]
        return says_something_of_the_deck(one, result_of_run(tmp_path, one))

    assert says(good) and says("termination: error\nreason: NaN at t = 1\n", exit_code=2)
    assert says(good, signal=9, timed_out=True, time_limit=2.0)
    assert not says(good, signal=9) and not says(good, exit_code=127) and not says("termination: interrupted\nreason: a signal\n")
    full = str(OutputError(Path("history.h5"), OSError(28, "No space left on device"))).split("\n")[0]
    assert not says(f'termination: error\nreason: "{full}"\n', exit_code=2)
    assert result_of_run(tmp_path, RunRecord(exit_code=2)).verdict == Verdict.broken, "not what a case may ask for"


def test_digests_of_decks_count_what_they_include(tmp_path: Path) -> None:
    deck = tmp_path / "deck.k"
    deck.write_text("*KEYWORD\n*INCLUDE\n par +\nt.k \n*INCLUDE_TRANSFORM\n'moved.k'\n1,2\n*END\n")
    for name in ("part.k", "moved.k"):
        (tmp_path / name).write_text("*NODE\n")
    before = digest_of_deck(deck)
    assert digest_of_deck(deck) == before
    for name in ("part.k", "moved.k"):
        (tmp_path / name).write_text("*NODE \n")
        assert digest_of_deck(deck) != before
        (tmp_path / name).write_text("*NODE\n")
    assert digest_of_deck(deck) == before


def test_digests_know_parameters_and_folders_of_includes(tmp_path: Path) -> None:
    (tmp_path / "mesh").mkdir()
    deck = tmp_path / "deck.k"
    deck.write_text("*KEYWORD\n*PARAMETER\nC    mesh    coarse\n*include_path_relative\nmesh\n*include\n&mesh\n*END\n")
    for name in ("coarse", "fine"):
        (tmp_path / "mesh" / name).write_text("*NODE\n")
    coarse, fine = digest_of_deck(deck), digest_of_deck(deck, {"mesh": "fine"})
    (tmp_path / "mesh" / "coarse").write_text("*NODE \n")
    assert digest_of_deck(deck) != coarse
    assert digest_of_deck(deck, {"mesh": "fine"}) == fine
    (tmp_path / "mesh" / "fine").write_text("*NODE \n")
    assert digest_of_deck(deck, {"mesh": "fine"}) != fine


def compared(folder: Path, before: SuiteResult, now: SuiteResult) -> Comparison:
    (folder / "old.csv").write_text(results_csv(before))
    out = compare_with(now, folder / "old.csv", Diagnostics())
    assert out is not None
    return out


def test_what_got_worse(tmp_path: Path) -> None:
    before = SuiteResult(Suite(), cases=[made_case()])
    o = before.cases[0].definition.observations[0]
    o.bound, o.bound_settings = 3e-4, ["a"]
    judge(before.cases[0])
    before.cases[0].runs[1].reason = 'a "reason", with\na line'
    now = copy.deepcopy(before)
    runs = now.cases[0].runs
    assert (compared(tmp_path, before, now).lines, compared(tmp_path, before, now).compared) == ([], 6)
    runs[0].observed[0].error *= 1.04
    runs[0].cpu_seconds = 1.25
    assert compared(tmp_path, before, now).lines == [], "small changes say nothing"
    runs[0].cpu_seconds, runs[1].observed[0].error = 1.4, 1e-3 / 2
    c = compared(tmp_path, before, now)
    assert [(line.text, line.worse) for line in c.lines] == [
        ("wave: a, 10: 1400 ns of CPU time per particle and step, was 1000", True),
        ("wave: a, 20, height: error 0.0005, was 0.001", False),
    ]
    assert not c.regressed
    runs[2].observed[0].error = 1
    judge(now.cases[0])
    c = compared(tmp_path, before, now)
    assert c.regressed and c.lines[2].text == "wave: a, 40, height: check missed, was met"
    assert not compared(tmp_path, now, before).regressed
    assert not compared(tmp_path, now, now).regressed, "what was missed before may stay so"
    now = copy.deepcopy(before)
    now.cases[0].runs[3].verdict, now.cases[0].runs[3].as_required, now.cases[0].runs[3].reason = Verdict.stopped, False, "NaN"
    c = compared(tmp_path, before, now)
    assert c.regressed and c.lines[0].text == "wave: b, 10: stopped, was stable: NaN"
    now.cases[0].runs.pop()
    assert compared(tmp_path, before, now).lines[-1].text == "wave: b, 40, height: no longer there"
    for text in (None, "", "a,b\n1,2\n", "\x00"):
        if text is not None:
            (tmp_path / "wrong.csv").write_text(text)
        diagnostics = Diagnostics()
        assert compare_with(now, tmp_path / "wrong.csv", diagnostics) is None
        assert not diagnostics.ok


def test_table_for_the_terminal() -> None:
    result = SuiteResult(Suite(), cases=[made_case()])
    result.cases[0].definition.observations[0].bound = 1e-5
    judge(result.cases[0])
    table = case_table(result.cases[0])
    assert re.search(r" 0\.025 % +2\.00\n", table) and "\u00a0" not in table
    assert checks_text(result) == (
        "  MISSED  wave: a, height: error at most 0.001 %, measured 0.025 %\n"
        "  MISSED  wave: b, height: error at most 0.001 %, measured not a number\n0 of 2 checks met, 2 missed\n"
    )
    assert "ok: false" in results_yaml(result)
    assert checks_text(SuiteResult(Suite())) == "The suite states no bounds.\n"
    map_ = case_table(stability(3, 2))
    assert "map: S stable, D degraded, X stopped, R refused, ! broken" in map_


def test_result_files_say_all_that_came_out() -> None:
    result = whole_suite()
    rows = list(csv.DictReader(results_csv(result).splitlines()))
    assert len(rows) == sum(max(1, len(run.observed)) for case in result.cases for run in case.runs)
    assert {row["check"] for row in rows if row["case"] == "wave" and row["resolution"] != "80"} == {""}
    assert [row["check"] for row in rows if row["case"] == "wave" and row["resolution"] == "80"] == ["met", "", "met", "", "missed", ""]
    content = yaml.safe_load(results_yaml(suite(*result.cases)))
    assert content["cases"][0]["runs"][3]["observed"][0]["value"] == pytest.approx(1.27 * (1 + 0.5 / 80), rel=1e-12)
    assert [case["name"] for case in content["cases"]] == [case.definition.name for case in result.cases]
    assert math.isnan(content["cases"][4]["checks"][0]["measured"])


def test_time_left() -> None:
    schedule = RunSchedule([(0, 8), (0, 1), (1, 2), (1, 1)], 2)
    assert schedule.seconds_left() is None, "nothing is known yet"
    schedule.started(1)
    schedule.ended(1, 2)
    assert schedule.seconds_left() == pytest.approx(16), "the longest run"
    schedule.ended(0, 24)  # case 0 takes 26/9 s per unit of cost, and case 1 is expected to be like it
    assert schedule.seconds_left() == pytest.approx(2 * 26 / 9)
    schedule.ended(3, 1)
    assert (schedule.seconds_left(), schedule.done) == (pytest.approx(2), 3)
    assert [duration_text(s) for s in (59.4, 185, 7800)] == ["59 s", "3 min 05 s", "2 h 10 min"]
