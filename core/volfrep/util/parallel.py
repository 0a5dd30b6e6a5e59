# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls that one job divides its work into, made side by side by threads or by other processes.

Large arrays that all of the calls need lie in files for other processes, which map them: each is
sent a path, and what was written a moment ago is still in memory. Those that are made for many such
calls lie in files from the start (`ParallelBackend.gathered`), are not copied for any, and grow
there.
"""

from __future__ import annotations

import itertools
import mmap
import pickle
import shutil
import tempfile
import weakref
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, Literal, Protocol, TypeVar

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
    """An array in a file that processes map into their memory.

    Attributes:
        path: of the file, which may hold more after it.
        dtype: as numpy names it.
        shape: of the array.
        order: in which the file has its numbers.
    """

    path: Path
    dtype: str
    shape: tuple[int, ...]
    order: Literal["C", "F"] = "C"

    @property
    def array(self) -> NDArray[Any]:
        """It, read only; the file is closed once nobody has this any more."""
        import numpy as np

        mapped = np.memmap(self.path, self.dtype, "r", 0, self.shape, self.order)
        found: NDArray[Any] = np.asarray(mapped)
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
    """A value in a file whose arrays processes map into their memory.

    Of it a call is sent a few bytes: a large value has thousands of arrays.

    Attributes:
        path: of the file.
        last: where the value without its arrays, pickled, and the place of each begin, bytes.
    """

    path: Path
    last: int

    @property
    def value(self) -> Shared:
        """It, made anew; the file is closed once nobody has its arrays any more."""
        with self.path.open("rb") as file:
            data = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
        rest, spans = pickle.loads(data[self.last :])
        found: Shared = pickle.loads(rest, buffers=[data[low:high] for low, high in spans])
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

    def sees(self, array: NDArray[Any]) -> bool:
        """Whether an array lies in a file for other processes already: `gathered` was."""
        return self.uses_processes and _file_of(array) is not None

    @contextmanager
    def sharing(self, *arrays: NDArray[Any]) -> Iterator[tuple[SharedArray, ...]]:
        """Arrays of numbers for the calls.

        Raises:
            OSError: the disk of temporary files is full.
        """
        if not self.uses_processes or not all(array.size for array in arrays):
            yield tuple(LocalArray(array) for array in arrays)
            return
        with _folder() as folder:
            yield tuple(
                _in_file(array) or _saved(array, folder / str(number))
                for number, array in enumerate(arrays)
            )

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
        with _new_file() as rows, rows.path.open("wb") as file:
            for block in blocks:
                file.write(np.ascontiguousarray(block).data)
        return rows.mapped(np.dtype(dtype).str, shape)

    def made(
        self,
        function: Callable[..., NDArray[Number]],
        given: Iterable[tuple[int, tuple[Any, ...]]],
        shape: tuple[int, int],
        dtype: type[Number],
    ) -> NDArray[Number]:
        """As `gathered`, of rows that a function of a module makes: processes write them there.

        Args:
            function: gives (k, columns) of the dtype.
            given: how many rows come of each call, and its arguments.
            shape: as of `gathered`.
            dtype: as of `gathered`.

        Raises:
            OSError: as of `sharing`.
        """
        import numpy as np

        if not self.uses_processes or not shape[0]:
            return self.gathered((function(*some) for _, some in given), shape, dtype)
        each = shape[1] * np.dtype(dtype).itemsize
        with _new_file() as rows:
            with rows.path.open("wb") as file:
                file.truncate(shape[0] * each)
            counts, arguments = zip(*given, strict=True)
            places = itertools.accumulate(counts, initial=0)
            calls = zip(arguments, places, strict=False)
            for _ in self.starmap(
                _write_rows, ((rows.path, each * place, function, some) for some, place in calls)
            ):
                pass
        return rows.mapped(np.dtype(dtype).str, shape)

    def extended(self, array: NDArray[Number], more: NDArray[Number]) -> NDArray[Number]:
        """As `gathered`, an array and then more rows; one that lies in a file grows there.

        Args:
            array: (k, columns), which stays as it is.
            more: (j, columns) of the same kind.

        Raises:
            OSError: as of `sharing`.
        """
        rows = _file_of(array) if self.uses_processes else None
        shape = (len(array) + len(more), array.shape[1])
        if rows is None or not rows.ends_with(array):
            return self.gathered((array, more), shape, array.dtype.type)
        rows.append(more)
        return rows.mapped(array.dtype.str, shape)

    def replaced(
        self, array: NDArray[Number], rows: NDArray[Any], values: NDArray[Number]
    ) -> NDArray[Number]:
        """As `gathered`, an array with other numbers in a few of its rows.

        Args:
            array: (k, columns), which stays as it is.
            rows: of it.
            values: what is to stand there.

        Raises:
            OSError: as of `sharing`.
        """
        import numpy as np

        whole = _file_of(array) if self.uses_processes else None
        if whole is None or not whole.ends_with(array):
            result = array.copy()
            result[rows] = values
            return result
        # The system copies a file in half the time that memory takes, whose pages it clears first.
        with _new_file() as copy:
            shutil.copyfile(whole.path, copy.path)
            np.memmap(copy.path, array.dtype, "r+", 0, array.shape)[rows] = values
        return copy.mapped(array.dtype.str, array.shape)

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
                for buffer in buffers:
                    file.write(bytes(-file.tell() % ALIGNED))
                    begin = file.tell()
                    spans.append((begin, begin + file.write(buffer.raw())))
                last = file.tell()
                file.write(pickle.dumps((rest, spans), protocol=5))
            yield MappedValue(path, last)


class _RowFile:
    """A file of rows, which arrays map from its beginning on; it goes with the last of them."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="volfrep-", ignore_cleanup_errors=True)
        self.path = Path(self._folder.name) / "rows"
        self._maps = 0

    def mapped(self, dtype: str, shape: tuple[int, ...]) -> NDArray[Any]:
        """Its first rows, read only."""
        import numpy as np

        found = np.memmap(self.path, dtype, "r", 0, shape)
        self._maps += 1
        _row_files[str(self.path)] = self
        weakref.finalize(found.base, self._left)  # what maps the file: Windows wants it gone
        return np.asarray(found)

    def ends_with(self, array: NDArray[Any]) -> bool:
        """Whether an array that maps it maps all of it."""
        return self.path.stat().st_size == array.nbytes

    def append(self, rows: NDArray[Any]) -> None:
        """More rows at its end; arrays that map it stay as they are."""
        import numpy as np

        with self.path.open("ab") as file:
            file.write(np.ascontiguousarray(rows).data)

    def remove(self) -> None:
        """The file goes."""
        self._folder.cleanup()

    def _left(self) -> None:
        self._maps -= 1
        if not self._maps:
            self.remove()


#: The files of rows that arrays map, by their paths.
_row_files: weakref.WeakValueDictionary[str, _RowFile] = weakref.WeakValueDictionary()


def _write_rows(
    path: Path, place: int, function: Callable[..., NDArray[Any]], given: tuple[Any, ...]
) -> None:
    """What a function makes of this into a file, so many bytes from its beginning."""
    import numpy as np

    block = np.ascontiguousarray(function(*given))
    with path.open("r+b") as file:
        file.seek(place)
        file.write(block.data)


@contextmanager
def _new_file() -> Iterator[_RowFile]:
    """A file of rows that are written now; where that fails it goes at once."""
    rows = _RowFile()
    try:
        yield rows
    except BaseException:
        rows.remove()
        raise


def _file_of(array: NDArray[Any]) -> _RowFile | None:
    """Where an array of `gathered` lies, with all of its rows; None where it does not."""
    import numpy as np

    whole = array.base
    if not isinstance(whole, np.memmap) or whole.filename is None:
        return None
    is_whole = array.__array_interface__ == whole.__array_interface__
    return _row_files.get(str(whole.filename)) if is_whole else None


def _in_file(array: NDArray[Any]) -> MappedArray | None:
    """An array where it lies in a file of rows; None where it does not."""
    rows = _file_of(array)
    return None if rows is None else MappedArray(rows.path, array.dtype.str, array.shape)


def _saved(array: NDArray[Any], path: Path) -> MappedArray:
    """An array in a new file."""
    import numpy as np

    turned = array.flags.f_contiguous and not array.flags.c_contiguous
    with path.open("wb") as file:
        file.write(np.ascontiguousarray(array.T if turned else array).data)
    return MappedArray(path, array.dtype.str, array.shape, "F" if turned else "C")


@contextmanager
def _folder() -> Iterator[Path]:
    """A folder of files for a while."""
    # Where a reader is ended in the middle of it, Windows keeps its file for a moment.
    with tempfile.TemporaryDirectory(prefix="volfrep-", ignore_cleanup_errors=True) as folder:
        yield Path(folder)
