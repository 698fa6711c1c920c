#!/usr/bin/env python3
"""Packages of Courant, each by one command: a Debian package of the build, the source archive, a container image.

usage: packages.py deb|source|image [FOLDER]
Files go to FOLDER, build/packages if it is not given. `deb` packs the build that COURANT_BUILD names (build/release), else one is made
in build/wheel, and checks the package with lintian; DEBFULLNAME and DEBEMAIL name the maintainer. `source` packs the committed tree.
`image` builds the container from the Debian package in FOLDER, by podman or docker. The wheel is made by `pip wheel .`
(wheel_of_build.py).
"""
from __future__ import annotations

import gzip
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from datetime import datetime, timezone
from pathlib import Path

sys.dont_write_bytecode = True
import wheel_of_build  # noqa: E402

ROOT = wheel_of_build.ROOT
VERSION = wheel_of_build._version()
# lintian wants an address that can exist: give DEBEMAIL
MAINTAINER = f"{os.environ.get('DEBFULLNAME', 'The Courant authors')} <{os.environ.get('DEBEMAIL', 'courant@localhost.localdomain')}>"

CONTROL = """\
Package: courant
Version: {version}
Section: science
Priority: optional
Architecture: {architecture}
Maintainer: {maintainer}
Installed-Size: {size}
Depends: {depends}, python3 (>= 3.11), python3 (<< 3.12), python3-numpy, python3-h5py, python3-yaml
Recommends: python3-matplotlib, python3-scipy
Suggests: ffmpeg, paraview, python3-meshio, python3-vtk9
Description: explicit dynamics of water, structures and gases from keyword decks
 Courant runs LS-DYNA-style keyword decks: smoothed particle hydrodynamics for
 water, gases and solids, finite elements for solids, shells and beams, rigid
 bodies with joints, and contact between all of them. Each run ends with a
 verdict on whether its results can be trusted.
 .
 This package contains the program courant, its library, the Python package
 courant, ready decks, and manual pages.
"""

COPYRIGHT = """\
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: courant

Files: *
Copyright: {owner}
License: BSD-3-clause

License: BSD-3-clause
{text}
"""

COMPILE = """\
#!/bin/sh
set -e
if [ "$1" = configure ] && command -v py3compile > /dev/null 2>&1; then
    py3compile -p courant
fi
"""

CLEAN = """\
#!/bin/sh
set -e
if command -v py3clean > /dev/null 2>&1; then
    py3clean -p courant
fi
"""


def run(*words: object, folder: Path | None = None) -> str:
    done = subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"error: {' '.join(str(word) for word in words)} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def compressed(file: Path, data: bytes) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("wb") as packed, gzip.GzipFile("", "wb", 9, packed, mtime=0) as stream:
        stream.write(data)


def committed() -> datetime:
    """Time of the last commit, so that the same tree gives the same package; now, outside of git."""
    done = subprocess.run(["git", "-C", ROOT, "log", "-1", "--format=%ct"], capture_output=True, text=True)
    return datetime.fromtimestamp(int(done.stdout), timezone.utc) if done.returncode == 0 else datetime.now(timezone.utc)


def stage_files(installed: Path, root: Path, multiarch: str) -> list[Path]:
    """Files of the package below `root`; the binaries among them."""
    usr, private = root / "usr", f"/usr/lib/{multiarch}/courant"
    program, library = usr / "bin" / "courant", root / private[1:] / "libcourant.so.0"
    module = f"_courant{sysconfig.get_config_var('EXT_SUFFIX')}"
    package = usr / "lib" / "python3" / "dist-packages" / "courant"
    for folder in (program.parent, library.parent, usr / "share" / "courant" / "python"):
        folder.mkdir(parents=True)
    shutil.copy2(installed / "bin" / "courant", program)
    shutil.copyfile((installed / "lib" / "libcourant.so.0").resolve(), library)
    shutil.copytree(installed / "share" / "courant" / "python" / "courant", package, ignore=shutil.ignore_patterns("__pycache__"))
    (package / "py.typed").touch()
    (usr / "share" / "courant" / "python" / "courant").symlink_to("../../../lib/python3/dist-packages/courant")
    shutil.copytree(installed / "share" / "courant" / "keyword_decks", usr / "share" / "courant" / "keyword_decks",
                    ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(installed / "share" / "bash-completion", usr / "share" / "bash-completion")
    for page in (installed / "share" / "man" / "man1").glob("*.1"):
        compressed(usr / "share" / "man" / "man1" / f"{page.name}.gz", page.read_bytes())
    binaries = [program, library, *([package / module] if (package / module).is_file() else [])]
    for file in binaries:
        run("strip", "--remove-section=.comment", "--remove-section=.note", "--strip-unneeded", file)
        if file != library:
            run("patchelf", "--set-rpath", private, file)
    return binaries


def documents(root: Path) -> None:
    folder = root / "usr" / "share" / "doc" / "courant"
    text = (ROOT / "LICENSE").read_text(encoding="utf-8")
    owner = re.search(r"^Copyright \(c\) (.*)$", text, re.MULTILINE)
    terms = text[text.index("Redistribution"):].strip()
    folder.mkdir(parents=True)
    (folder / "copyright").write_text(COPYRIGHT.format(owner=owner[1] if owner else "", text="\n".join(f" {line or '.'}" for line in terms.split("\n"))),
                                      encoding="utf-8")
    entry = f"courant ({VERSION}) unstable; urgency=medium\n\n  * New version; changes are in CHANGES.gz.\n\n -- {MAINTAINER}  {committed():%a, %d %b %Y %H:%M:%S +0000}\n"
    compressed(folder / "changelog.gz", entry.encode())
    compressed(folder / "CHANGES.gz", (ROOT / "docs" / "changelog.md").read_bytes())


def deb(folder: Path) -> Path:
    os.environ.setdefault("COURANT_BUILD", "build/release")
    if not (ROOT / os.environ["COURANT_BUILD"] / "courant").is_file():
        del os.environ["COURANT_BUILD"]
    build = wheel_of_build._build()
    architecture, multiarch = run("dpkg", "--print-architecture").strip(), run("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip()
    target = folder / f"courant_{VERSION}_{architecture}.deb"
    with tempfile.TemporaryDirectory() as made:
        installed, root = Path(made, "installed"), Path(made, "root")
        run("cmake", "--install", build, "--prefix", installed)
        binaries = stage_files(installed, root, multiarch)
        documents(root)
        for path in sorted(root.rglob("*")):
            if not path.is_symlink():
                executable = path.is_dir() or path == binaries[0] or (path.is_file() and path.suffix == ".sh")
                path.chmod(0o755 if executable else 0o644)
        control = root / "DEBIAN"
        (Path(made) / "debian").mkdir()
        (Path(made) / "debian" / "control").write_text("Source: courant\n\nPackage: courant\nArchitecture: any\n", encoding="utf-8")
        private = binaries[1].parent
        found = run("dpkg-shlibdeps", "-O", f"-l{private}", "--ignore-missing-info", *(f"-e{file}" for file in binaries), folder=Path(made))
        depends = next(line.partition("=")[2] for line in found.splitlines() if line.startswith("shlibs:Depends="))
        files = [path for path in sorted(root.rglob("*")) if path.is_file() and not path.is_symlink()]
        size = sum(-(-path.stat().st_size // 1024) for path in files)
        control.mkdir()
        (control / "control").write_text(CONTROL.format(version=VERSION, architecture=architecture, maintainer=MAINTAINER, size=size, depends=depends),
                                         encoding="utf-8")
        (control / "md5sums").write_text("".join(f"{hashlib.md5(path.read_bytes()).hexdigest()}  {path.relative_to(root)}\n" for path in files),
                                         encoding="utf-8")
        for name, script in (("postinst", COMPILE), ("prerm", CLEAN)):
            (control / name).write_text(script, encoding="utf-8")
            (control / name).chmod(0o755)
        os.environ["SOURCE_DATE_EPOCH"] = str(int(committed().timestamp()))
        run("dpkg-deb", "--root-owner-group", "--build", root, target)
    if shutil.which("lintian"):
        print(subprocess.run(["lintian", "--fail-on", "error,warning", "--allow-root", target], capture_output=True, text=True).stdout or "lintian: clean")
    else:
        print("lintian is missing (apt-get install lintian): the package is not checked")
    return target


def source(folder: Path) -> Path:
    target = folder / f"courant-{VERSION}.tar.gz"
    run("git", "-C", ROOT, "archive", f"--prefix=courant-{VERSION}/", "-o", target, "HEAD")
    return target


def image(folder: Path) -> Path:
    engine = shutil.which("podman") or shutil.which("docker")
    if engine is None:
        raise SystemExit("error: neither podman nor docker is there\n  hint: apt-get install podman")
    package = max(folder.glob("courant_*.deb"), default=None, key=lambda file: file.stat().st_mtime)
    if package is None:
        raise SystemExit(f"error: {folder} has no Debian package\n  hint: python3 cmake/packages.py deb first")
    shutil.copyfile(ROOT / "cmake" / "Containerfile", folder / "Containerfile")
    run(engine, "build", "-t", f"courant:{VERSION}", "-f", folder / "Containerfile", folder)
    return Path(f"courant:{VERSION}")


def main() -> int:
    calls = {"deb": deb, "source": source, "image": image}
    if len(sys.argv) not in (2, 3) or sys.argv[1] not in calls:
        sys.stderr.write(__doc__ or "")
        return 1
    folder = Path(sys.argv[2] if len(sys.argv) > 2 else ROOT / "build" / "packages").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    print(calls[sys.argv[1]](folder))
    return 0


if __name__ == "__main__":
    sys.exit(main())
