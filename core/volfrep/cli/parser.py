# SPDX-License-Identifier: LGPL-2.1-or-later
"""argparse as the command wants it: one sentence for an error, values that begin with a minus."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn, TypeVar

from ..util.deprecation import PARAMETERS, current_name
from ..util.errors import VolfrepError
from ..util.version import describe

Number = TypeVar("Number", int, float)

#: Options of earlier versions, and what they are called now.
RENAMED = {
    "--radius-law": "--radius-profile",
    "--radius-min": "--radius-start",
    "--radius-max": "--radius-end",
    "--lambda": "--lambda-formula",
    "--lambda-min": "--lambda-start",
    "--lambda-max": "--lambda-end",
    "--stretch-struts": "--no-keep-radius",
}
#: What `--output` once took.
_ONCE_MADE = ("part", "lattice", "domain")


class Parser(argparse.ArgumentParser):
    """An argument parser whose errors are one sentence, without the usage in front.

    What begins with a minus and a digit is a value, such as -1e3, -5,0,0 or -5:0.4,0:1: no
    option does.
    """

    def __init__(self, *args: object, **kwargs: object) -> None:
        super().__init__(*args, **kwargs)  # type: ignore[arg-type]
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message: str) -> NoReturn:
        """Refuse the arguments."""
        raise VolfrepError(f"{message[:1].upper()}{message[1:]} (see '{self.prog} --help').")


class Version(argparse.Action):
    """Prints the version when it is asked for, and not before."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Print and exit; argparse's signature."""
        print(describe())
        parser.exit()


def refuse_old(arguments: Sequence[str]) -> None:
    """Refuse what an earlier version took, naming what it is written as now.

    Raises:
        VolfrepError: for the first such argument.
    """
    for argument, following in zip(arguments, [*arguments, ""][1:], strict=True):
        option, _, value = argument.partition("=")
        if option == "--compact":
            raise VolfrepError(
                "--compact is gone: give a larger --deviation, which saves more and takes no time."
            )
        if option in RENAMED:
            raise VolfrepError(f"{option} is called {RENAMED[option]} now.")
        if option == "--output" and (value or following) in _ONCE_MADE:
            raise VolfrepError(
                f"--output takes the file to write, as -o does: choose what to make by --make "
                f"{value or following}."
            )


def with_current_options(arguments: Sequence[str]) -> list[str]:
    """Arguments by the names that options of parameters have today; a warning for each old one.

    Raises:
        VolfrepError: one has changed two minor versions ago.
    """
    return [_current(word) if word.startswith("--") else word for word in arguments]


def _current(word: str) -> str:
    option, mark, value = word.partition("=")
    name = option[2:].replace("-", "_")
    now = current_name(name, PARAMETERS, _as_option, lambda said: say(f"warning: {said}"))
    return word if now == name else _as_option(now) + mark + value


def _as_option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def say(text: str) -> None:
    """A line on the terminal's error stream."""
    print(f"volfrep: {text}", file=sys.stderr)


def three_whole_numbers(text: str) -> tuple[int, ...]:
    """Three whole numbers between commas."""
    return _split(
        text, ",", int, 3, "not three whole numbers with commas, NX,NY,NZ, such as 10,10,10"
    )


def numbers(text: str) -> tuple[float, ...]:
    """Numbers between commas."""
    return _split(text, ",", float, None, "no list of numbers with commas")


def three_numbers(text: str) -> tuple[float, ...]:
    """Three numbers between commas."""
    return _split(text, ",", float, 3, "not three numbers with commas, X,Y,Z, such as 0,0,1")


def shard(text: str) -> tuple[int, ...]:
    """I of N, from 1 on."""
    return _split(text, "/", int, 2, "no shard, I/N, such as 1/4")


def _split(
    text: str, mark: str, kind: Callable[[str], Number], count: int | None, what: str
) -> tuple[Number, ...]:
    """The numbers between marks, so many where that is given; `what` a text is that has others."""
    try:
        found = tuple(kind(word) for word in text.split(mark))
    except ValueError:
        found = ()
    if not found or count not in (None, len(found)):
        raise argparse.ArgumentTypeError(f"'{text}' is {what}")
    return found
