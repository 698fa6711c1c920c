"""python3 -m courant post|verify ..."""

from __future__ import annotations

import os
import signal
import sys

from .words import did_you_mean


def main(words: list[str]) -> int:
    """The exit code of the call."""
    calls = ("post", "verify")
    if not words or words[0] in ("-h", "--help"):
        print("usage: courant post RECIPE DIR\n       courant verify SUITE\n\n`courant post --help` tells the options of a call.")
        return 0 if words else 1
    if words[0] == "post":
        from .post.command import main as call
    elif words[0] == "verify":
        from .verify.cli import main as call  # type: ignore[assignment]
    else:
        hint = did_you_mean(words[0], calls).replace("did you mean ", "did you mean `courant ").replace("? ", "`?")
        sys.stderr.write(f"error: '{words[0]}' is no call of this package\n  hint: {hint or 'the calls are post and verify'}\n")
        return 1
    return call(words[1:])


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    try:
        code = main(sys.argv[1:])
        sys.stdout.flush()
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)
    except BrokenPipeError:  # nobody reads any more
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 2
    sys.exit(code)
