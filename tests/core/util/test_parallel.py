# SPDX-License-Identifier: LGPL-2.1-or-later
"""Arrays that calls of other processes share."""

import pickle
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from volfrep.util.parallel import LocalArray, MappedArray, ParallelBackend, SharedArray


class Processes(ParallelBackend):
    """Shares as for processes, and has none."""

    @property
    def uses_processes(self) -> bool:
        """As of any backend."""
        return True


BLOCKS = (np.arange(6.0).reshape(2, 3), np.asfortranarray(np.arange(9.0).reshape(3, 3)))
ROWS = np.concatenate(BLOCKS)


def path_of(shared: SharedArray) -> Path:
    assert isinstance(shared, MappedArray)
    return shared.path


@pytest.mark.parametrize("backend", [ParallelBackend(), Processes()])
def test_what_comes_some_rows_at_a_time_is_one_array_that_is_shared_uncopied(
    backend: ParallelBackend,
) -> None:
    found = backend.gathered(iter(BLOCKS), (5, 3), np.float64)
    assert found.dtype == np.float64
    assert np.array_equal(found, ROWS)
    with backend.sharing(found) as (first,), backend.sharing(found) as (second,):
        assert np.array_equal(first.array, ROWS)
        if isinstance(first, LocalArray):
            assert first.array is found
        else:
            assert path_of(first) == path_of(second)


def test_a_part_of_an_array_in_a_file_is_not_taken_for_it() -> None:
    found = Processes().gathered(iter(BLOCKS), (5, 3), np.float64)
    for part in (found[1:], found[:, ::-1], found[::-1]):
        with Processes().sharing(part) as (shared,):
            assert np.array_equal(shared.array, part)


def test_the_file_of_an_array_goes_with_it() -> None:
    found = Processes().gathered(iter(BLOCKS), (5, 3), np.float64)
    with Processes().sharing(found) as (shared,):
        path = path_of(shared)
    rows = found[2:4]
    del found
    assert np.array_equal(rows, ROWS[2:4])
    assert path.exists()
    del rows
    assert not path.parent.exists()


@pytest.mark.parametrize("backend", [ParallelBackend(), Processes()])
def test_an_array_that_grows_stays_as_it_was(backend: ParallelBackend) -> None:
    found = backend.gathered(iter(BLOCKS), (5, 3), np.float64)
    longer = backend.extended(found, -BLOCKS[0])
    other = backend.extended(found, -BLOCKS[1])  # once more from the same
    longest = backend.extended(longer, BLOCKS[1])
    del longer
    wanted = np.concatenate([ROWS, -BLOCKS[0], BLOCKS[1]])
    with backend.sharing(found, other, longest) as shared:
        for array in (found, shared[0].array):
            assert np.array_equal(array, ROWS)
        for array in (other, shared[1].array):
            assert np.array_equal(array, np.concatenate([ROWS, -BLOCKS[1]]))
        for array in (longest, shared[2].array):
            assert np.array_equal(array, wanted)
        if backend.uses_processes:  # it grew where it was; from there on it had grown already
            assert path_of(shared[0]) == path_of(shared[2]) != path_of(shared[1])


def doubled(rows: SharedArray, start: int, end: int) -> NDArray[np.float64]:
    return 2.0 * rows.array[start:end]


@pytest.mark.parametrize("backend", [ParallelBackend(), Processes()])
def test_rows_that_calls_make_stand_in_the_order_of_these(backend: ParallelBackend) -> None:
    spans = (0, 2), (2, 2), (2, 5)
    with backend.sharing(ROWS) as (rows,):
        calls = ((end - start, (rows, start, end)) for start, end in spans)
        found = backend.made(doubled, calls, (5, 3), np.float64)
    assert np.array_equal(found, 2.0 * ROWS)
    with backend.sharing(found) as (first,), backend.sharing(found) as (second,):
        assert np.array_equal(first.array, found)
        if backend.uses_processes:
            assert path_of(first) == path_of(second)


@pytest.mark.parametrize("backend", [ParallelBackend(), Processes()])
def test_rows_of_an_array_change_in_a_copy_of_its_file(backend: ParallelBackend) -> None:
    found = backend.gathered(iter(BLOCKS), (5, 3), np.float64)
    changed = backend.replaced(found, np.array([1, 4]), -BLOCKS[0])
    wanted = ROWS.copy()
    wanted[[1, 4]] = -BLOCKS[0]
    assert np.array_equal(found, ROWS)
    with backend.sharing(found, changed) as (first, second):
        assert np.array_equal(second.array, wanted)
        if backend.uses_processes:
            assert path_of(first) != path_of(second)
    del found
    assert np.array_equal(changed, wanted)


def test_an_array_of_columns_is_shared_in_its_order() -> None:
    with Processes().sharing(ROWS.T, ROWS[:, ::-1]) as (columns, turned):
        assert np.array_equal(columns.array, ROWS.T)
        assert columns.array.flags.f_contiguous
        assert np.array_equal(turned.array, ROWS[:, ::-1])


def test_of_a_value_that_is_shared_a_call_is_sent_its_place_only() -> None:
    steps = [np.arange(float(k)) for k in range(500)]
    value = {"steps": steps, "name": "octants", "turned": ROWS.T}
    with Processes().sharing_value(value) as shared:
        sent = pickle.dumps(shared)
        assert len(sent) < 1000
        found = pickle.loads(sent).value
    assert found["name"] == "octants"
    for step, wanted in zip(found["steps"], steps, strict=True):
        assert np.array_equal(step, wanted)
    assert np.array_equal(found["turned"], ROWS.T)


def test_no_file_is_left_where_rows_do_not_come(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))

    def stops() -> object:
        yield BLOCKS[0]
        raise MemoryError

    with pytest.raises(MemoryError):
        Processes().gathered(stops(), (5, 3), np.float64)  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())
