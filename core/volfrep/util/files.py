# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writing a file so that it is either complete or not there, and never over one that is read."""

from __future__ import annotations

import json
import os
import secrets
import shutil
import tempfile
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path
from typing import Any, BinaryIO

from .errors import VolfrepError

#: What Windows says of a file that is to be replaced while a program holds it open.
_WINDOWS_HOLDS = (5, 32)
#: There a file has one place at a time.
_placing = threading.Lock()
#: What the files that the running job reads are called, by device and number on it, which are the
#: same through every link; None outside of `keeping_inputs`.
_inputs: ContextVar[dict[tuple[int, int], str] | None] = ContextVar("inputs", default=None)


@contextmanager
def keeping_inputs() -> Iterator[None]:
    """A job of one or several files: within it, none that it reads is written over.

    What comes through `reading` is noted by itself; `check_writable`, by which all that is written
    goes, refuses it. A job in a job is one with it.
    """
    if _inputs.get() is not None:
        yield
        return
    token = _inputs.set({})
    try:
        yield
    finally:
        _inputs.reset(token)


def note_input(path: str | os.PathLike[str], what: str) -> None:
    """Note that the job reads a file, by what a user calls it; one that is not there is none."""
    inputs = _inputs.get()
    if inputs is None:
        return
    with suppress(OSError, ValueError):  # whoever reads it will say so
        inputs[_number(path)] = what


def refuse_input(path: str | os.PathLike[str]) -> None:
    """Refuse to write a file that the job reads, through symbolic and hard links too.

    Raises:
        VolfrepError: naming it.
    """
    inputs = _inputs.get()
    if not inputs:
        return
    try:
        what = inputs.get(_number(path))
    except (OSError, ValueError):  # nothing is there, so nothing is lost
        return
    if what is not None:
        raise VolfrepError(
            f"Cannot write '{path}': it is the {what} itself, which is read: give another name."
        )


def _number(path: str | os.PathLike[str]) -> tuple[int, int]:
    status = os.stat(path)
    return status.st_dev, status.st_ino


def check_writable(path: str | os.PathLike[str]) -> Path:
    """The path itself, once it is clear that a file could be put there.

    Raises:
        VolfrepError: the folder does not exist or is closed to us, or the name is taken by
            something that is not a file, or by one that the job reads (`keeping_inputs`).
    """
    target = Path(path)
    try:
        folder = target.resolve().parent
        taken = target.exists()
        if not folder.is_dir():
            raise VolfrepError(f"Cannot write '{target}': there is no folder '{folder}'.")
        if taken and not target.is_file():
            raise VolfrepError(f"Cannot write '{target}': it exists and is not a file.")
    except OSError as error:  # a name too long, a loop of links
        raise VolfrepError(f"Cannot write '{target}': {error.strerror}.") from error
    if not os.access(folder, os.W_OK) or (taken and not os.access(target, os.W_OK)):
        raise VolfrepError(f"Cannot write '{target}': permission denied.")
    refuse_input(target)
    return target


def same_file(one: str | os.PathLike[str], other: str | os.PathLike[str]) -> bool:
    """Whether both paths mean one file, through symbolic and hard links too.

    Paths where nothing is yet are compared by where a file written there would be.
    """
    try:
        return os.path.samefile(one, other)
    except OSError:  # at least one is not there, or cannot be looked at
        first, second = (os.path.normcase(Path(path).resolve()) for path in (one, other))
        return first == second


def refuse_overwriting(
    outputs: Mapping[str, str | os.PathLike[str]], inputs: Mapping[str, str | os.PathLike[str]]
) -> None:
    """Refuse to write a file over one that the job is made of.

    Args:
        outputs: paths to be written, by what a user calls them ("output", "report").
        inputs: paths that are read, the same way ("part", "cell file").

    Raises:
        VolfrepError: naming the two.
    """
    for what, path in outputs.items():
        for source, read in inputs.items():
            if same_file(path, read):
                raise VolfrepError(
                    f"The {what} '{path}' is the {source} itself: give another name."
                )


@contextmanager
def replacing(path: str | os.PathLike[str], size: int = 0) -> Iterator[BinaryIO]:
    """A binary file to write, which takes the target's place only when the block succeeds.

    It is written beside the target (beside what a link points at); after an error or an
    interruption it is removed, and whatever the target held before is untouched.

    Args:
        path: of the target.
        size: bytes that will be written at least, where that is known.

    Raises:
        VolfrepError: naming the target and why it cannot be written (a full disk included, before
            anything is written where the size is known).
    """
    target = check_writable(path)
    refuse_full(target, size)
    real = target.resolve()
    part = real.with_name(f".volfrep-{secrets.token_hex(4)}.part")
    try:
        try:
            with part.open("xb") as file:
                yield file
            if real.exists():
                shutil.copymode(real, part)
            os.replace(part, real)
        finally:
            part.unlink(missing_ok=True)
    except OSError as error:
        raise not_written(target, error) from error


def make_folder(path: str | os.PathLike[str]) -> Path:
    """A folder for files, made where it is not there.

    Raises:
        VolfrepError: it cannot be made.
    """
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise VolfrepError(f"Cannot make the folder '{folder}': {error.strerror}.") from error
    return folder


def write_json(path: str | os.PathLike[str], values: Any) -> None:
    """Write plain values as an indented JSON text; an old file stays if anything goes wrong.

    Raises:
        VolfrepError: it cannot be written.
    """
    with replacing(path) as file:
        file.write(json.dumps(values, indent=2).encode() + b"\n")


def write_at(file: BinaryIO, data: memoryview, place: int) -> None:
    """Write bytes at a place of an open file, from any thread.

    Raises:
        OSError: as of any writing.
    """
    if not hasattr(os, "pwrite"):  # Windows
        with _placing:
            file.seek(place)
            file.write(data)
        return
    left = data.cast("B")
    while left:
        done = os.pwrite(file.fileno(), left, place)
        left, place = left[done:], place + done


def refuse_full(path: str | os.PathLike[str], size: int) -> None:
    """Raise a `VolfrepError` where the disk has no room for so many bytes (more) of a file."""
    free = shutil.disk_usage(Path(path).resolve().parent).free
    if size > free:
        raise VolfrepError(
            f"Cannot write '{path}': it will have {size / 1e9:.3g} GB and the disk has "
            f"{free / 1e9:.3g} GB left; free some, or use a coarser resolution or fewer cells."
        )


@contextmanager
def staged(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A path of the same name in a new folder beside the target, for whoever may be ended at work.

    What is there when the block succeeds takes the target's place; the folder goes in any case.
    Errors that name the path name the target then.

    Raises:
        VolfrepError: naming the target and why it cannot be written.
    """
    target = check_writable(path)
    real = target.resolve()
    try:
        with tempfile.TemporaryDirectory(prefix=".volfrep-", dir=real.parent) as folder:
            unfinished = Path(folder) / real.name
            try:
                yield unfinished
            except VolfrepError as error:
                error.args = (str(error).replace(str(unfinished), str(target)),)
                raise
            if real.exists():
                shutil.copymode(real, unfinished)
            os.replace(unfinished, real)
    except OSError as error:
        raise not_written(target, error) from error


def not_written(target: Path, error: OSError) -> VolfrepError:
    """Why a file could not be written or put in another's place."""
    if getattr(error, "winerror", None) in _WINDOWS_HOLDS:
        return VolfrepError(
            f"Cannot write '{target}': {error.strerror}; it may be open in another program."
        )
    return VolfrepError(f"Cannot write '{target}': {error.strerror}.")
