"""python3 -m courant generate|run|check|post|report|verify|view|schema|lsp ..."""

from __future__ import annotations

import os
import signal
import sys

from .words import did_you_mean

_SYSTEM_PYTHON = "/usr/bin/python3"  # the distribution's, where another one shadows it
_NEEDED = ("numpy", "h5py", "yaml")


def _with_modules() -> str:
    """Goes on in the distribution's Python where this one lacks modules; gives what is missing where that cannot be."""
    try:
        for name in _NEEDED:
            __import__(name)
    except ImportError as fault:
        home = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
        if os.path.exists(_SYSTEM_PYTHON) and os.path.realpath(sys.executable) != os.path.realpath(_SYSTEM_PYTHON):
            paths = os.pathsep.join([home, *filter(None, [os.environ.get("PYTHONPATH")])])
            os.execve(_SYSTEM_PYTHON, [_SYSTEM_PYTHON, "-m", "courant", *sys.argv[1:]], os.environ | {"PYTHONPATH": paths})
        return f"error: the Python module '{fault.name}' is missing\n  hint: apt-get install python3-numpy python3-h5py python3-yaml\n"
    return ""


def main(words: list[str]) -> int:
    """The exit code of the call."""
    calls = ("generate", "run", "check", "post", "report", "verify", "view", "schema", "lsp")
    if not words or words[0] in ("-h", "--help"):
        print("usage: courant generate SCENE.yaml -o DECK.k\n       courant run SCENE.yaml -o DIR\n       courant post RECIPE DIR\n       courant report DIR\n       courant verify SUITE\n       courant view DIR\n       courant schema scene|recipe|suite\n       courant lsp\n\n`courant post --help` tells the options of a call.")
        return 0 if words else 1
    if words[0] not in calls:
        near = did_you_mean(words[0], calls).removeprefix("did you mean ").removesuffix("? ")
        hint = f"did you mean `courant {near}`?" if near else f"the calls are {', '.join(calls[:-1])} and {calls[-1]}"
        sys.stderr.write(f"error: '{words[0]}' is no call of this package\n  hint: {hint}\n")
        return 1
    if missing := _with_modules():
        sys.stderr.write(missing)
        return 3
    if words[0] in ("run", "check"):
        from .scene.run_command import main as of_scene
        return of_scene(words[0], words[1:])
    if words[0] == "generate":
        from .scene.command import main as call
    elif words[0] == "post":
        from .post.command import main as call  # type: ignore[assignment]
    elif words[0] == "report":
        from .report import main as call  # type: ignore[assignment]
    elif words[0] == "view":
        from .viewing import main as call  # type: ignore[assignment]
    elif words[0] == "schema":
        from .schema import main as call  # type: ignore[assignment]
    elif words[0] == "lsp":
        from .lsp.command import main as call  # type: ignore[assignment]
    else:
        from .verify.cli import main as call  # type: ignore[assignment]
    return call(words[1:])


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8", errors="surrogateescape")  # type: ignore[union-attr]  # names of files as they are
    try:
        code = main(sys.argv[1:])
        if not sys.stdout.closed:  # the language server closes it
            sys.stdout.flush()
    except KeyboardInterrupt:
        code = 128 + signal.SIGINT
    sys.exit(code)
