# SPDX-License-Identifier: LGPL-2.1-or-later
"""What two processes say to each other: pickled values, whose large arrays go through files.

Both ends are this engine's own, and started one by the other. Stage caches are never sent: each
stands for one that the receiver keeps under the same number. Arrays are sent as bytes, and not as
numpy pickles them: two processes may have numpys that do not know each other's pickles.
"""

from __future__ import annotations

import io
import itertools
import os
import pickle
import struct
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any, Literal

import numpy as np

from ..util.cache import StageCache

#: Arrays of so many bytes go through a file, which is written and read in one piece without
#: Python's lock; through a pipe they would ask for it at every 64 kB.
LARGE = 1 << 20
_HEAD = struct.Struct("<QQ")
_files = itertools.count()


def send(
    stream: IO[bytes], value: object, folder: Path, counterpart: Callable[[StageCache], int]
) -> None:
    """Write a value.

    Args:
        stream: of bytes, which is flushed.
        value: anything that pickles.
        folder: where files of large arrays may lie; whoever reads them removes them.
        counterpart: the number that a cache is known by.

    Raises:
        OSError: the other end is gone, or the folder is full.
    """
    paths: list[Path] = []

    def keep(buffer: pickle.PickleBuffer) -> bool:
        raw = buffer.raw()
        if raw.nbytes < LARGE:
            return True
        path = folder / f"{os.getpid()}-{next(_files)}"
        paths.append(path)
        with path.open("wb") as file:
            file.write(raw)
        return False

    class Pickler(pickle.Pickler):
        def persistent_id(self, found: object) -> int | None:
            return counterpart(found) if isinstance(found, StageCache) else None

        def reducer_override(self, found: Any) -> Any:
            if type(found) is not np.ndarray or found.dtype.kind not in "biufcSU":
                return NotImplemented
            turned = found.flags.f_contiguous and not found.flags.c_contiguous
            rows = found.T if turned else np.ascontiguousarray(found)
            data = pickle.PickleBuffer(rows.reshape(-1).view(np.uint8).data)
            return _array, (data, found.dtype.str, found.shape, "F" if turned else "C")

    text = io.BytesIO()
    try:
        Pickler(text, protocol=5, buffer_callback=keep).dump(value)
    except BaseException:
        for path in paths:
            path.unlink(missing_ok=True)
        raise
    names = "\n".join(path.name for path in paths).encode()
    stream.write(_HEAD.pack(len(names), text.tell()) + names)
    stream.write(text.getbuffer())
    stream.flush()


def receive(stream: IO[bytes], folder: Path, counterpart: Callable[[int], StageCache]) -> Any:
    """Read a value that `send` has written into the same folder.

    Raises:
        EOFError: the other end is gone.
    """
    names_length, length = _HEAD.unpack(_read(stream, _HEAD.size))
    names = _read(stream, names_length).decode()
    text = _read(stream, length)
    buffers = []
    for name in names.split("\n") if names else ():
        path = folder / name
        buffers.append(np.fromfile(path, np.uint8))
        path.unlink()

    class Unpickler(pickle.Unpickler):
        def persistent_load(self, number: Any) -> StageCache:
            return counterpart(number)

    return Unpickler(io.BytesIO(text), buffers=buffers).load()


def _array(data: Any, dtype: str, shape: tuple[int, ...], order: Literal["C", "F"]) -> Any:
    return np.frombuffer(data, dtype).reshape(shape, order=order)


def _read(stream: IO[bytes], length: int) -> bytes:
    data = stream.read(length)
    if len(data) < length:
        raise EOFError
    return data
