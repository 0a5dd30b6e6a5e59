# SPDX-License-Identifier: LGPL-2.1-or-later
"""``python -m volfrep`` and the ``volfrep`` command: Ctrl-C counts from the first import on."""

from __future__ import annotations

import sys
from typing import NoReturn

from .cli import interrupts
from .util.version import describe


def main() -> NoReturn:
    """Run the command of this process's arguments and exit with its code."""
    try:
        interrupts.prepare()
        if sys.argv[1:] == ["--version"]:  # without the options of all commands
            print(describe())
            raise SystemExit(0)
        from .cli.command import run

        code = run(sys.argv[1:])
    except SystemExit as end:  # of --help and --version
        code = int(end.code or 0)
    except KeyboardInterrupt:
        code = interrupts.say_interrupted()
    interrupts.leave(code)
    raise AssertionError("the process has ended")


if __name__ == "__main__":
    main()
