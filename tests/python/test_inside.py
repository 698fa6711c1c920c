"""Runs in the process of Python: the bits of the command line, callbacks, changes, and clean ends."""
from __future__ import annotations

import os
import re
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import courant
import numpy as np
import pytest
from courant.native import native
from courant.post.view_fields import field_names
from courant.run_options import cores

pytestmark = pytest.mark.skipif(native() is None, reason="the extension module is missing: apt-get install pybind11-dev")

# A unit cube of steel without gravity, and a rigid one beside it, in kg, m, s
_BLOCK = """\
*KEYWORD
*TITLE
two cubes
*CONTROL_TERMINATION
{end}
*DATABASE_BINARY_D3PLOT
1.0
*DATABASE_GLSTAT
1.0e-5
*NODE
1,0,0,0
2,1,0,0
3,1,1,0
4,0,1,0
5,0,0,1
6,1,0,1
7,1,1,1
8,0,1,1
11,3,0,0
12,4,0,0
13,4,1,0
14,3,1,0
15,3,0,1
16,4,0,1
17,4,1,1
18,3,1,1
*ELEMENT_SOLID
1,1,1,2,3,4,5,6,7,8
2,2,11,12,13,14,15,16,17,18
*PART
soft
1,1,1
*PART
stiff
2,1,2
*SECTION_SOLID
1,1
*MAT_ELASTIC
1,7800,2.1e11,0.3
*MAT_RIGID
2,7800,2.1e11,0.3
*END
"""


def deck(folder: Path, end: float = 0.01, more: str = "") -> Path:
    file = folder / "cubes.k"
    file.write_text(_BLOCK.format(end=end).replace("*END\n", more + "*END\n"))
    return file


def pool(**keys: Any) -> courant.Scene:
    # by contact: mirrors beside the body take most of the time, and are compared with the command line in test_scene_runs.py
    scene = courant.Scene("pool", **({"spacing": 0.05, "end": 0.03, "output": 0.01, "wall_method": "contact"} | keys))
    scene.water(low=(0, 0, 0), high=(0.4, 0.3, 0.2)).box(low=(0, 0, 0), high=(0.6, 0.3, 0.4), open=["top"])
    return scene.body(box={"low": [0.1, 0.1, 0.25], "high": [0.2, 0.2, 0.3]}, density=500)


def bits(run: courant.Run) -> list[bytes]:
    return [state[name].tobytes() for state in run.states for name in ("velocity", "pressure", "density", "id")]


def test_the_bits_are_those_of_the_command_line_also_of_a_second_run(tmp_path: Path) -> None:
    outside = pool().run(tmp_path / "outside", quiet=True, in_process=False)
    with pytest.raises(courant.CourantError):  # a run that fails leaves nothing behind
        courant.run(deck(tmp_path, more="*MAT_ELASTIC\n9,-1,1,0.3\n"), tmp_path / "bad", quiet=True)
    seen: list[int] = []
    first = pool().run(tmp_path / "first", quiet=True, callback=lambda state: seen.append(state.cycle))
    second = pool().run(tmp_path / "second", quiet=True, threads=2)
    assert bits(first) == bits(second) == bits(outside) and len(bits(outside)) >= 16
    assert seen == list(range(first.summary["steps"]))
    assert first.summary["units"] == {"mass": "kg", "length": "m", "time": "s"} and first.verdict == outside.verdict


def test_views_show_the_state_and_keep_it(tmp_path: Path) -> None:
    kept: list[tuple[np.ndarray, np.ndarray]] = []
    over: list[Any] = []

    def look(state: courant.LiveState) -> None:
        particles = state.particles
        assert len(particles) == len(particles["pressure"]) == particles["velocity"].shape[0]
        at = particles.index([particles.ids[7], particles.ids[0]])
        assert at.tolist() == [7, 0] and particles.unit("velocity.z") == "m/s" and "speed" in particles
        view = particles["position.z"]
        assert not view.flags.writeable and view.base is not None
        with pytest.raises(KeyError, match="no number 999999"):
            particles.index(999999)
        with pytest.raises(KeyError, match="no field 'presure'"):
            particles["presure"]
        kept.extend((particles[name], particles[name].copy()) for name in ("position.z", "velocity.x", "density", "smoothing_length", "pressure", "id", "mass"))
        over.append(state)

    plain = pool().run(tmp_path / "plain", quiet=True)
    run = pool().run(tmp_path / "run", quiet=True, callback=look)
    assert bits(plain) == bits(run) and len(kept) > 70
    assert all((view == copy).all() for view, copy in kept)
    with pytest.raises(RuntimeError, match="the run has gone on"):
        over[0].particles  # noqa: B018


def test_a_loop_over_states(tmp_path: Path) -> None:
    steps = pool().steps(tmp_path / "run", every=0.01, quiet=True)
    heights = [(state.t, state.bodies[101].x[2]) for state in steps]
    assert len(heights) == 5 and [t for t, _ in heights][:4] == pytest.approx([0, 0.01, 0.02, 0.03], abs=2e-3)
    fallen = [0.275 - z for _, z in heights]
    assert fallen[2] == pytest.approx(0.5 * 9.81 * heights[2][0] ** 2, rel=0.05)  # it has not reached the water
    assert steps.result is not None and steps.result.termination == "normal"
    early = pool().steps(tmp_path / "early", every_steps=2, quiet=True)
    for state in early:
        if state.cycle >= 6:
            break
    assert courant.open(tmp_path / "early").summary["termination"] == "interrupted"
    assert courant.open(tmp_path / "early").summary["steps"] == 7
    assert "stopped by the program" in courant.open(tmp_path / "early").summary["reason"]
    for folder in ("one", "two"):
        assert len([state.t for state in courant.steps(deck(tmp_path, 1e-3), tmp_path / folder, every=5e-4, quiet=True)]) == 4  # the end is one of its own


def test_an_exception_ends_the_run_cleanly(tmp_path: Path) -> None:
    def fail(state: courant.LiveState) -> None:
        if state.cycle == 3:
            raise ZeroDivisionError("of mine")

    with pytest.raises(ZeroDivisionError, match="of mine"):
        pool().run(tmp_path / "run", quiet=True, callback=fail)
    left = courant.open(tmp_path / "run")
    assert left.summary["termination"] == "interrupted" and "stopped by the program" in left.summary["reason"]
    assert left.summary["steps"] == 4 and len(left.states) == 2
    with pytest.raises(ZeroDivisionError, match="of mine"):
        for state in pool().steps(tmp_path / "loop", every_steps=1, quiet=True):
            fail(state)
    assert courant.open(tmp_path / "loop").summary["termination"] == "interrupted"
    assert "stopped by the program" in courant.open(tmp_path / "loop").summary["reason"]


@contextmanager
def ctrl_c(folder: Path) -> Iterator[None]:
    """Presses it shortly after the run in the folder has begun."""
    def press() -> None:
        while not (folder / "messag").exists():
            time.sleep(0.01)
        time.sleep(0.2)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    yield
    thread.join()


@pytest.mark.parametrize("in_process", [True, False])
def test_ctrl_c_ends_a_run_with_its_results_and_is_raised(tmp_path: Path, in_process: bool) -> None:
    folder = tmp_path / "run"
    with ctrl_c(folder), pytest.raises(KeyboardInterrupt, match=re.escape(f"courant.open('{folder}')")):
        pool(end=100).run(folder, quiet=True, in_process=in_process)
    left = courant.open(folder)
    assert left.summary["termination"] == "interrupted" and "stopped by a signal" in left.summary["reason"] and len(left.states) >= 2
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    with pytest.raises(KeyboardInterrupt):  # and is caught as usual afterwards
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(1)


def test_ctrl_c_in_a_callback_or_a_loop_is_raised(tmp_path: Path) -> None:
    with ctrl_c(tmp_path / "callback"), pytest.raises(KeyboardInterrupt):
        pool(end=100).run(tmp_path / "callback", quiet=True, callback=lambda state: time.sleep(0.1))
    with ctrl_c(tmp_path / "loop"), pytest.raises(KeyboardInterrupt):
        for _ in pool(end=100).steps(tmp_path / "loop", quiet=True, every=1.0):
            pass
    for folder in ("callback", "loop"):
        assert courant.open(tmp_path / folder).summary["termination"] == "interrupted"


def test_a_stop_of_another_thread_gives_the_results(tmp_path: Path) -> None:
    stop = native().Stop()
    threading.Timer(1.0, stop.ask).start()
    assert pool(end=100).run(tmp_path / "run", quiet=True, stop=stop).termination == "interrupted"


def test_forces_do_work_from_outside(tmp_path: Path) -> None:
    force, mass = 1.0e6, 7800.0

    def push(state: courant.LiveState) -> None:
        if state.cycle == 0:
            state.nodes.set_force((force / 8, 0, 0), ids=range(1, 9))
            state.bodies[2].push(force=(0, force, 0), moment=(0, 0, 1000.0))
        seen.append((state.t, state.dt, state.nodes["velocity"][state.nodes.index(range(1, 9)), 0].mean(), state.bodies[2].v[1], state.bodies[2].omega[2]))

    seen: list[tuple[float, ...]] = []
    run = courant.run(deck(tmp_path, 0.004), tmp_path / "run", quiet=True, callback=push, threads=1)
    t, dt, soft, stiff, turn = np.array(seen).T
    half = t[1:] - 0.5 * dt[:-1] - 0.5 * dt[0]  # of v^{n-1/2}, since the first half step: the force acts from the second step on
    for v, slope in ((soft, force / mass), (stiff, force / mass), (turn, 1000.0 / (mass / 6))):
        assert v[1:] == pytest.approx(slope * half, rel=1e-9, abs=1e-12)
    energy, end = run.summary["energy"], run.summary["time"] - 0.5 * dt[-1] - 0.5 * dt[0]
    gained = mass * (force / mass * end) ** 2 + 0.5 * mass / 6 * (1000.0 / (mass / 6) * end) ** 2
    assert energy["external_work"] == pytest.approx(gained, rel=1e-6) and energy["kinetic"] == pytest.approx(gained, rel=1e-6)
    assert abs(energy["error"]) < 1e-9


def test_velocities_bring_energy_from_outside(tmp_path: Path) -> None:
    def move(state: courant.LiveState) -> None:
        if state.cycle == 4:
            state.nodes.set_velocity((3.0, 0, 0), ids=range(1, 9))
            state.bodies[2].move(velocity=(0, 0, 2.0), omega=(0, 1.0, 0))

    run = courant.run(deck(tmp_path, 0.004), tmp_path / "run", quiet=True, callback=move)
    expected = 0.5 * 7800 * (9 + 4) + 0.5 * 7800 / 6
    energy = run.summary["energy"]
    assert energy["external_work"] == pytest.approx(expected, rel=1e-12) and energy["kinetic"] == pytest.approx(expected, rel=1e-9)
    assert abs(energy["error"]) < 1e-9


@pytest.mark.parametrize(("change", "message"), [
    (lambda state: state.nodes.set_force((1, 0, 0), ids=11), "node 11 goes with a rigid body"),
    (lambda state: state.nodes.set_velocity((float("nan"), 0, 0), ids=1), "finite"),
    (lambda state: state.nodes.set_force((1, 0), ids=1), "three components"),
    (lambda state: state.nodes.set_force((1, 0, "a"), ids=1), "three components, .* as numbers"),
    (lambda state: state.bodies[2].push(force=(0, "a", 0)), r"^force=\(0, 'a', 0\): expected three numbers; give force="),
    (lambda state: state.bodies[2].push(moment=3), "^moment=3: expected three numbers"),
    (lambda state: state.bodies[2].move(omega=(0, 1)), r"^omega=\(0, 1\): expected three numbers"),
    (lambda state: state["solids of part 1"].set_force((0, 0, 0)), "do not move by forces of their own"),
    (lambda state: state.bodies[2].push(force=(0, 0, float("inf"))), "finite")])
def test_what_cannot_be_changed_is_refused(tmp_path: Path, change: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        courant.run(deck(tmp_path), tmp_path / "run", quiet=True, callback=change)


def test_a_body_that_is_not_there_is_refused_with_those_there_are(tmp_path: Path) -> None:
    with pytest.raises(KeyError, match="the run has no rigid body 7; it has 2"):
        courant.run(deck(tmp_path), tmp_path / "run", quiet=True, callback=lambda state: state.bodies[7].push())


def follow(_: courant.LiveState) -> None:
    pass


@pytest.mark.parametrize(("options", "message"), [
    ({"callback": follow, "every_steps": -3}, "every_steps=-3: expected a whole number of steps > 0\n  hint: "),
    ({"callback": follow, "every_steps": 1.5}, "every_steps=1.5: expected a whole number"),
    ({"callback": follow, "every": -1}, "every=-1: expected a time > 0\n  hint: "),
    ({"every_steps": 3}, "every_steps=3 has no effect without a callback\n  hint: "),
    ({"every": 0.1, "in_process": False}, "every=0.1 has no effect without a callback"),
    ({"callback": 5}, "callback=5: expected a function\n  hint: "),
    ({"threads": "two"}, "threads='two': expected a whole number >= 0\n  hint: "),
    ({"threads": -1}, "threads=-1: expected a whole number >= 0"),
    ({"threads": 4 * cores() + 1}, f"expected at most {4 * cores()}, 4 for each core\n  hint: one for each core is quickest: {cores()}"),
    ({"until": -1}, "^error: until=-1: expected a time > 0\n  hint: "),
    ({"until": "end"}, "^error: until='end': expected a time > 0")])
def test_options_are_checked_before_the_run(tmp_path: Path, options: dict[str, Any], message: str) -> None:
    with pytest.raises(courant.CourantError, match=message):
        courant.run(deck(tmp_path), tmp_path / "run", quiet=True, **options)
    assert not (tmp_path / "run").exists()


def test_options_of_a_loop_are_checked(tmp_path: Path) -> None:
    with pytest.raises(courant.CourantError, match="every_steps=-3"):
        list(courant.steps(deck(tmp_path), tmp_path / "run", every_steps=-3, quiet=True))


def test_errors_of_a_deck_name_file_line_and_field(tmp_path: Path) -> None:
    with pytest.raises(courant.CourantError) as fault:
        courant.run(deck(tmp_path, more="*MAT_ELASTIC\n9,-1,1,0.3\n"), tmp_path / "run", quiet=True)
    one = fault.value.diagnostics.all[0]
    assert (Path(one.where.file).name, one.field, one.severity) == ("cubes.k", "RO", "error") and one.where.line > 40
    with pytest.raises(courant.CourantError, match="several runs"):
        courant.run(deck(tmp_path, more="*CASE_BEGIN_1\n*CASE_END_1\n*CASE\n1,one\n1\n"), tmp_path / "run", quiet=True, callback=print)
    with pytest.raises(courant.CourantError, match="extension module"):
        courant.run(deck(tmp_path), tmp_path / "run", quiet=True, callback=print, in_process=False)


def test_only_one_run_at_a_time(tmp_path: Path) -> None:
    def again(_: courant.LiveState) -> None:
        courant.run(deck(tmp_path), tmp_path / "other", quiet=True)

    with pytest.raises(RuntimeError, match="another run goes on"):
        courant.run(deck(tmp_path), tmp_path / "run", quiet=True, callback=again)


def test_progress_and_parameters(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    lines: list[str] = []
    file = deck(tmp_path)
    file.write_text(file.read_text().replace("*CONTROL_TERMINATION\n0.01\n", "*PARAMETER\nR last,0.01\n*CONTROL_TERMINATION\n&last\n"))
    run = courant.run(file, tmp_path / "run", progress=lines.append, parameters={"last": 0.05})
    assert run.summary["time"] == pytest.approx(0.05, rel=1e-2)
    courant.run(file, tmp_path / "said", until=0.001)
    assert "two cubes" in capfd.readouterr().out


def in_units(folder: Path, ro: float, modulus: float) -> courant.Run:
    file = deck(folder, 1e-5)
    file.write_text(file.read_text().replace("7800,2.1e11", f"{ro},{modulus}"))
    return courant.run(file, folder / "run", quiet=True)


def test_units_are_those_that_the_numbers_look_like(tmp_path: Path) -> None:
    run = in_units(tmp_path, 7.8e-9, 2.1e5)
    assert run.units == courant.Units("t", "mm", "s") and run.states[0].shells.unit("velocity") == "mm/s"
    assert run.energies.units["kinetic"] == "t mm2/s2" and "hourglass" in run.energies.names and "time" not in run.energies.names
    assert courant.open(run.folder, courant.Units("g", "mm", "ms")).units.time == "ms"
    seen: list[str] = []
    courant.run(tmp_path / "cubes.k", tmp_path / "other", quiet=True, callback=lambda state: seen.append(state.nodes.unit("velocity")))
    assert seen[0] == "mm/s"


def test_where_no_system_fits_units_are_those_of_the_model(tmp_path: Path) -> None:
    run = in_units(tmp_path, 123.0, 456.0)
    assert "units" not in run.summary and run.states[0].shells.unit("velocity") == "model units"
    assert run.energies.units["kinetic"] == "model units" and "time_step" not in run.energies.names


def test_displacement_counts_from_the_first_state(tmp_path: Path) -> None:
    run = courant.run(deck(tmp_path, 0.004), tmp_path / "run", quiet=True, callback=lambda state: state.bodies[2].move(velocity=(0, 0, 50.0)))
    last = run.states[-1].shells
    moved = last["displacement"][last["id"] > 10] if len(last["id"]) == len(last) else last["displacement"][-8:]
    assert moved[:, 2] == pytest.approx(50 * run.summary["time"], rel=0.1) and last.unit("displacement") == "m"
    assert "displacement" in last and "displacement.z" in field_names(last)
    run.states[-1].plot("displacement.z", tmp_path / "moved.png")
    assert (tmp_path / "moved.png").stat().st_size > 5000
