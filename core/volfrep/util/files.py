# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writing a file so that it is either complete or not there."""

from __future__ import annotations

import os
import secrets
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from .errors import VolfrepError

#: What Windows says of a file that is to be replaced while a program holds it open.
_WINDOWS_HOLDS = (5, 32)


def check_writable(path: str | os.PathLike[str]) -> Path:
    """The path itself, once it is clear that a file could be put there.

    Raises:
        VolfrepError: the folder does not exist or is closed to us, or the name is taken by
            something that is not a file.
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


def refuse_full(path: str | os.PathLike[str], size: int) -> None:
    """Raise a `VolfrepError` where the disk has no room for so many bytes (more) of a file."""
    free = shutil.disk_usage(Path(path).resolve().parent).free
    if size > free:
        raise VolfrepError(
            f"Cannot write '{path}': it will have {size / 1e9:.3g} GB and the disk has "
            f"{free / 1e9:.3g} GB left; free some, or use a coarser resolution or fewer cells."
        )


@contextmanager
def beside(path: str | os.PathLike[str]) -> Iterator[Path]:
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


@contextmanager
def replacing_folder(path: str | os.PathLike[str], mark: str) -> Iterator[Path]:
    """A folder to fill, which takes the target's place only when the block succeeds.

    It is made beside the target; after an error or an interruption it is removed.

    Args:
        path: of the target: nothing yet, an empty folder, or one that holds a file `mark`, which
            tells that it was made the same way and may be replaced.
        mark: a file's name.

    Raises:
        VolfrepError: naming the target and why it cannot be written.
    """
    target = Path(path)
    try:
        real = target.resolve()
        if not real.parent.is_dir():
            raise VolfrepError(f"Cannot write '{target}': there is no folder '{real.parent}'.")
        if real.exists() and not real.is_dir():
            raise VolfrepError(f"Cannot write '{target}': it exists and is not a folder.")
        if real.exists() and any(real.iterdir()) and not (real / mark).is_file():
            raise VolfrepError(
                f"Cannot write '{target}': the folder holds other files; name a new one."
            )
        part = real.with_name(f".volfrep-{secrets.token_hex(4)}.part")
        part.mkdir()
        try:
            yield part
            if real.exists():
                old = real.with_name(f".volfrep-{secrets.token_hex(4)}.old")
                os.replace(real, old)
                os.replace(part, real)
                shutil.rmtree(old)
            else:
                os.replace(part, real)
        finally:
            shutil.rmtree(part, ignore_errors=True)
    except OSError as error:
        raise not_written(target, error) from error
