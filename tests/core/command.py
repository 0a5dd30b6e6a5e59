# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command as the tests call it."""

from volfrep.cli import command as cli


def run(*arguments: object) -> int:
    """The exit code of `volfrep` with these arguments."""
    return cli.run([str(argument) for argument in arguments])


def fill(lattice: list[str], part: object, out: object, *more: object) -> int:
    """`volfrep fill` with a skin of 2 mm."""
    return run("fill", part, "-o", out, *lattice, "--shell", 2, *more)


def block(lattice: list[str], out: object, *more: object) -> int:
    """`volfrep block` of two cells."""
    return run("block", "-o", out, *lattice, "--count", "2,1,1", *more)
