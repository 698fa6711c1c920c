"""The wheel: program, library, extension module, Python package and pages of the manual, with the libraries that they need.

A build backend of PEP 517 without requirements: cmake, ninja, the compiler and patchelf are Debian's. `COURANT_BUILD=build/release` takes a build that
is there; else one is made in build/wheel. System libraries of the manylinux policy (libc, libm, libstdc++, libgcc_s) stay outside.
"""
from __future__ import annotations

import base64
import csv
import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# of PEP 600's policies, which every Linux has
_OF_SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|util|resolv|stdc\+\+|gcc_s|z)\.so.*|linux-vdso.*)")
_NEEDED = re.compile(r"^\s*(\S+) => (/\S+)", re.MULTILINE)

_METADATA = """\
Metadata-Version: 2.1
Name: courant
Version: {version}
Summary: explicit dynamics of water, structures and gases from keyword decks
Requires-Python: >=3.9
Requires-Dist: numpy
Requires-Dist: h5py
Requires-Dist: PyYAML
Provides-Extra: shapes
Requires-Dist: vtk; extra == "shapes"
Requires-Dist: meshio; extra == "shapes"
Provides-Extra: pictures
Requires-Dist: matplotlib; extra == "pictures"
Requires-Dist: scipy; extra == "pictures"
"""


def _run(*words: object) -> str:
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode:
        sys.stderr.write(done.stdout + done.stderr)
        raise SystemExit(f"error: {' '.join(str(word) for word in words)} ended with {done.returncode}")
    return done.stdout


def _version() -> str:
    found = re.search(r"project\(\s*courant\s+VERSION\s+([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert found
    return found[1]


def _tag() -> str:
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _build() -> Path:
    """The folder of a build with the extension module of this Python."""
    if given := os.environ.get("COURANT_BUILD"):
        return Path(ROOT, given)
    build = ROOT / "build" / "wheel"
    _run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCOURANT_UNITY=ON", "-DCOURANT_PRECOMPILED_HEADERS=ON",
         "-DCOURANT_TESTS=OFF", "-DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON", f"-DPython_EXECUTABLE={sys.executable}")
    _run("cmake", "--build", build)
    return build


def _libraries(files: list[Path]) -> dict[str, Path]:
    """Shared libraries that these need, by the name that they are asked for."""
    found: dict[str, Path] = {}
    for file in files:
        said = _run("ldd", file)
        if lacking := re.findall(r"(\S+) => not found", said):
            raise SystemExit(f"error: {file.name} needs {', '.join(lacking)}, which is not found")
        for name, path in _NEEDED.findall(said):
            if not _OF_SYSTEM.fullmatch(name):
                found[name] = Path(path).resolve()
    return found


def _stage(build: Path, stage: Path) -> None:
    """What the wheel holds, as it lies in site-packages: courant/, with bin and libs."""
    installed = stage.parent / "installed"
    _run("cmake", "--install", build, "--prefix", installed)
    package = stage / "courant"
    shutil.copytree(installed / "share" / "courant" / "python" / "courant", package)
    module = package / f"_courant{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not module.is_file():
        raise SystemExit(f"error: the build has no {module.name}\n  hint: apt-get install pybind11-dev, and build with this Python")
    (package / "bin").mkdir()
    program = package / "bin" / "courant"
    shutil.copy2(installed / "bin" / "courant", program)
    libs = package / "libs"
    libs.mkdir()
    source = installed / "share" / "courant" / "python" / "courant" / module.name
    for name, path in _libraries([installed / "bin" / "courant", source]).items():
        shutil.copyfile(path, libs / name)
        (libs / name).chmod(0o755)
    # the old kind of path counts for libraries of libraries, too
    for file, path in ((program, "$ORIGIN/../libs"), (module, "$ORIGIN/libs"), *((one, "$ORIGIN") for one in libs.iterdir())):
        _run("patchelf", "--force-rpath", "--set-rpath", path, file)
    (package / "py.typed").touch()
    data = stage / f"courant-{_version()}.data" / "data" / "share"
    for folder in ("man", "bash-completion"):
        if (installed / "share" / folder).is_dir():
            shutil.copytree(installed / "share" / folder, data / folder)


def _record(name: str, data: bytes) -> list[str]:
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return [name, f"sha256={digest}", str(len(data))]


def build_wheel(wheel_directory: str, config_settings: object = None, metadata_directory: object = None) -> str:
    """Makes the wheel; its name. The same tree gives the same bytes."""
    version = _version()
    name, info = f"courant-{version}-{_tag()}.whl", f"courant-{version}.dist-info"
    with tempfile.TemporaryDirectory() as made:
        stage = Path(made, "stage")
        stage.mkdir()
        _stage(_build(), stage)
        files = {str(file.relative_to(stage)): (file.read_bytes(), os.access(file, os.X_OK)) for file in sorted(stage.rglob("*")) if file.is_file()}
    files[f"{info}/METADATA"] = (_METADATA.format(version=version).encode(), False)
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: courant\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode(), False)
    files[f"{info}/entry_points.txt"] = (b"[console_scripts]\ncourant = courant.program:main\n", False)
    files[f"{info}/LICENSE"] = ((ROOT / "LICENSE").read_bytes(), False)
    rows = io.StringIO()
    csv.writer(rows, lineterminator="\n").writerows([*(_record(file, data) for file, (data, _) in files.items()), [f"{info}/RECORD", "", ""]])
    files[f"{info}/RECORD"] = (rows.getvalue().encode(), False)
    with zipfile.ZipFile(Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for file, (data, executable) in files.items():
            entry = zipfile.ZipInfo(file, (2020, 1, 1, 0, 0, 0))
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, (0o100755 if executable else 0o100644) << 16
            wheel.writestr(entry, data)
    return name


if __name__ == "__main__":  # python3 cmake/wheel_of_build.py FOLDER
    print(build_wheel(sys.argv[1] if len(sys.argv) > 1 else "."))
