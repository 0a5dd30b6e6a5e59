# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls that one job divides its work into, made side by side by threads or by other processes.

Large arrays that all of the calls need lie in files for other processes, which map them: each is
sent a path, and what was written a moment ago is still in memory. Those that are made for many such
calls lie in files from the start (`ParallelBackend.gathered`), and are not copied for any.
"""

from __future__ import annotations

import mmap
import pickle
import tempfile
import weakref
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeVar

from .threads import in_threads

if TYPE_CHECKING:  # the command's help needs no numpy
    import numpy as np
    from numpy.typing import NDArray

    Number = TypeVar("Number", bound=np.generic)

T = TypeVar("T")
Shared = TypeVar("Shared", covariant=True)

#: Arrays in files begin at multiples of so many bytes.
ALIGNED = 64


@dataclass(frozen=True, eq=False)
class LocalArray:
    """An array of this process, for its threads."""

    array: NDArray[Any]


@dataclass(frozen=True)
class MappedArray:
    """An array in a file that processes map into their memory."""

    path: Path

    @property
    def array(self) -> NDArray[Any]:
        """It, read only; the file is closed once nobody has this any more."""
        import numpy as np

        found: NDArray[Any] = np.asarray(np.load(self.path, mmap_mode="r"))
        return found


#: An array that calls of a function share, in this process or in others.
SharedArray = LocalArray | MappedArray


class SharedValue(Protocol[Shared]):
    """A value that calls of a function share; it pickles."""

    @property
    def value(self) -> Shared:
        """It; nobody writes into its arrays."""


@dataclass(frozen=True, eq=False)
class LocalValue(Generic[Shared]):
    """A value of this process, for its threads."""

    value: Shared


@dataclass(frozen=True)
class MappedValue(Generic[Shared]):
    """A value whose arrays lie in a file that processes map into their memory.

    Attributes:
        path: of the file.
        rest: the value without these, pickled.
        spans: where each begins and ends, bytes.
    """

    path: Path
    rest: bytes
    spans: tuple[tuple[int, int], ...]

    @property
    def value(self) -> Shared:
        """It, made anew; the file is closed once nobody has its arrays any more."""
        with self.path.open("rb") as file:
            data = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
        found: Shared = pickle.loads(
            self.rest, buffers=[data[low:high] for low, high in self.spans]
        )
        return found


class ParallelBackend:
    """Makes calls side by side: this one on threads of this process."""

    @property
    def uses_processes(self) -> bool:
        """Whether other processes of this machine make the calls."""
        return False

    @property
    def memory_mb(self) -> float:
        """Peak resident memory of these processes together, MB, where the system tells."""
        return 0.0

    def starmap(self, function: Callable[..., T], given: Iterable[tuple[Any, ...]]) -> Iterator[T]:
        """What a function of a module makes of each tuple of arguments, in their order."""
        return in_threads(lambda each: function(*each), given)

    def begun(self, function: Callable[..., T], *given: Any) -> Callable[[], T]:
        """Gives what a function of a module makes of this: a process begins with it at once.

        Where there is none it is made when it is asked for.
        """
        return partial(function, *given)

    @contextmanager
    def sharing(self, *arrays: NDArray[Any]) -> Iterator[tuple[SharedArray, ...]]:
        """Arrays of numbers for the calls.

        Raises:
            OSError: the disk of temporary files is full.
        """
        if not self.uses_processes or not all(array.size for array in arrays):
            yield tuple(LocalArray(array) for array in arrays)
            return
        import numpy as np

        with _folder() as folder:
            files = []
            for number, array in enumerate(arrays):
                file = _file_of(array)
                if file is None:
                    file = folder / f"{number}.npy"
                    np.save(file, array)
                files.append(file)
            yield tuple(MappedArray(file) for file in files)

    def gathered(
        self, blocks: Iterable[NDArray[Number]], shape: tuple[int, int], dtype: type[Number]
    ) -> NDArray[Number]:
        """Rows that come some at a time as one array; `sharing` does not copy it.

        Args:
            blocks: (k, columns) each.
            shape: rows, all together, and columns.
            dtype: of all blocks.

        Returns:
            Read only where it lies in a file, which goes with it.

        Raises:
            OSError: as of `sharing`.
        """
        import numpy as np

        if not self.uses_processes or not shape[0]:
            result, filled = np.empty(shape, dtype), 0
            for block in blocks:
                result[filled : filled + len(block)] = block
                filled += len(block)
            return result
        folder = tempfile.TemporaryDirectory(prefix="volfrep-", ignore_cleanup_errors=True)
        path = Path(folder.name) / "rows.npy"
        try:
            with path.open("wb") as file:
                head = {"descr": np.dtype(dtype).str, "fortran_order": False, "shape": shape}
                np.lib.format.write_array_header_1_0(file, head)  # type: ignore[no-untyped-call]
                for block in blocks:
                    file.write(np.ascontiguousarray(block).data)
            mapped = np.load(path, mmap_mode="r")
        except BaseException:
            folder.cleanup()
            raise
        weakref.finalize(mapped.base, folder.cleanup)  # what maps the file: Windows wants it gone
        return np.asarray(mapped)

    @contextmanager
    def sharing_value(self, value: T) -> Iterator[SharedValue[T]]:
        """A value for the calls, anything that pickles; `sharing` is for single arrays.

        Raises:
            OSError: as of `sharing`.
        """
        if not self.uses_processes:
            yield LocalValue(value)
            return
        buffers: list[pickle.PickleBuffer] = []
        rest = pickle.dumps(value, protocol=5, buffer_callback=buffers.append)
        with _folder() as folder:
            path, spans = folder / "arrays", []
            with path.open("wb") as file:
                file.write(bytes(ALIGNED))  # an empty file cannot be mapped
                for buffer in buffers:
                    file.write(bytes(-file.tell() % ALIGNED))
                    begin = file.tell()
                    spans.append((begin, begin + file.write(buffer.raw())))
            yield MappedValue(path, rest, tuple(spans))


def _file_of(array: NDArray[Any]) -> Path | None:
    """Where all of an array lies in a file of `gathered`; None where it does not."""
    import numpy as np

    whole = array.base
    if not isinstance(whole, np.memmap) or whole.filename is None:
        return None
    return Path(whole.filename) if array.__array_interface__ == whole.__array_interface__ else None


@contextmanager
def _folder() -> Iterator[Path]:
    """A folder of files for a while."""
    # Where a reader is ended in the middle of it, Windows keeps its file for a moment.
    with tempfile.TemporaryDirectory(prefix="volfrep-", ignore_cleanup_errors=True) as folder:
        yield Path(folder)
