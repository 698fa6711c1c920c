"""The wheel of the build: what it holds, and that it works in an environment of its own."""
from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("COURANT_EXECUTABLE", "")

pytestmark = [pytest.mark.skipif(not PROGRAM, reason="needs the program"),
              pytest.mark.skipif(shutil.which("patchelf") is None, reason="patchelf is missing")]

SCRIPT = """import courant
from courant.native import native
from courant.program import executable
assert native() and "site-packages" in native().__file__ and "site-packages" in executable(), (native(), executable())
scene = courant.Scene("box", spacing=0.05, end=0.02).water(low=(0, 0), high=(0.5, 0.5)).box(low=(0, 0), high=(1.5, 1), open=["top"])
print(scene.run("out", threads=1, quiet=True).verdict, scene.run("out", threads=1, quiet=True, in_process=False).verdict)
"""


def said(*words: object, folder: Path, **more: str) -> str:
    known = {name: value for name, value in os.environ.items() if name in ("PATH", "HOME", "LANG")}
    done = subprocess.run([str(word) for word in words], cwd=folder, env=known | more, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_wheel_holds_program_module_package_and_libraries(tmp_path: Path) -> None:
    build = Path(PROGRAM).resolve().parent
    if not list((build / "native").glob("_courant*.so")) or not (build / "cmake_install.cmake").is_file():
        pytest.skip("the build has no extension module")
    name = said(sys.executable, ROOT / "cmake" / "wheel_of_build.py", tmp_path, folder=tmp_path, COURANT_BUILD=str(build)).split()[-1]
    names = zipfile.ZipFile(tmp_path / name).namelist()
    for part in ("courant/bin/courant", "courant/libs/libcourant.so.0", "courant/scene/scene.py", "courant/py.typed", ".data/data/share/man/man1/courant-run.1"):
        assert any(part in one for one in names), part
    said(sys.executable, "-m", "venv", "--system-site-packages", "venv", folder=tmp_path)
    bin_folder = tmp_path / "venv" / "bin"
    said(bin_folder / "python", "-m", "pip", "install", "--no-index", "--no-deps", tmp_path / name, folder=tmp_path)
    libraries = said("ldd", next((tmp_path / "venv").glob("lib/*/site-packages/courant/bin/courant")), folder=tmp_path)
    assert "not found" not in libraries and str(build) not in libraries and str(tmp_path / "venv") in libraries
    (tmp_path / "script.py").write_text(SCRIPT)
    assert said(bin_folder / "python", "script.py", folder=tmp_path).split() == ["sound", "sound"]
    (tmp_path / "scene.yaml").write_text("water: {spacing: 0.1, blocks: [{low: [0, 0], high: [1, 1]}]}\nend: 0.01\n")
    assert "0 errors" in said(bin_folder / "courant", "check", "scene.yaml", folder=tmp_path)
    assert said(bin_folder / "courant", "--version", folder=tmp_path).startswith("courant ")
