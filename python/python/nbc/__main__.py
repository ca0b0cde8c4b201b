"""The program: the script `nbc` of the package, and `python -m nbc`."""

from __future__ import annotations

import os
import signal
import sys

from . import _nbc

__all__ = ["main"]


def main() -> int:
    """Runs the program with the arguments of this process, and returns its exit status."""
    # The program watches signals itself. What Python would do at Ctrl-C is undone; where Ctrl-C is ignored, as in the
    # background of a shell, it stays so.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    # A file that the program opens must not get the number of a closed standard stream.
    for stream in range(3):
        try:
            os.fstat(stream)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    return _nbc.program(["nbc", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
