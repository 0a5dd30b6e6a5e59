# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parallel loops use as many threads as they are told, and make the same of it."""

import os
import threading

import numpy as np
import pytest

from volfrep.design import scattered_field
from volfrep.design.spec import LatticeSpec
from volfrep.io.write import stl
from volfrep.jobs.blocks import block
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.spatial import proximity
from volfrep.util import threads
from volfrep.util.errors import VolfrepError
from volfrep.util.threads import in_threads, use_threads


@pytest.fixture(autouse=True)
def as_before():
    yield
    use_threads(0)


@pytest.fixture(scope="module")
def mesh():
    spec = LatticeSpec("BCC", 10.0, 1.0, shell=0.0, resolution=10)
    return block(spec, (2, 2, 2)).mesh


def test_untold_it_is_one_on_each_core_of_the_process():
    use_threads(0)
    assert 1 <= threads.threads() <= os.cpu_count()


def test_a_negative_number_is_refused_and_changes_nothing():
    use_threads(3)
    with pytest.raises(VolfrepError, match="cannot be -1 threads"):
        use_threads(-1)
    assert threads.threads() == 3


def test_one_item_is_worked_on_by_the_thread_that_asks():
    use_threads(3)
    here = threading.get_ident()
    assert list(in_threads(lambda _: threading.get_ident(), [0])) == [here]
    assert here not in in_threads(lambda _: threading.get_ident(), [0, 1])


@pytest.mark.parametrize("count", [1, 3])
def test_every_pool_has_the_told_size(mesh, tmp_path, monkeypatch, count):
    sizes = []
    pool = threads.ThreadPoolExecutor

    def counting(max_workers, **options):
        sizes.append(max_workers)
        return pool(max_workers=max_workers, **options)

    monkeypatch.setattr(threads, "ThreadPoolExecutor", counting)
    use_threads(count)
    measure(mesh)
    stl.write_stl(mesh, tmp_path / "block.stl")
    assert set(sizes) <= {count, min(2, count)}
    assert (count in sizes) == (count > 1)  # one needs no pool


def test_every_search_has_the_told_number(monkeypatch):
    asked = []

    def counting():
        asked.append(2)
        return 2

    for module in (proximity, scattered_field, threads):
        monkeypatch.setattr(module, "threads", counting)
    triangle = TriangleMesh(np.eye(3), np.array([[0, 1, 2]]))
    point = np.array([[0.2, 0.2, 1.0]])
    proximity.closest_points(triangle, point)
    assert asked.pop() == 2
    index = proximity.index_surface(triangle, 0.1)
    asked.clear()
    index.near(point)
    assert asked.pop() == 2
    scattered_field.PointField(np.eye(3), np.arange(3.0))(point)
    assert asked == [2]


def test_the_file_is_the_same_with_any_number(mesh, tmp_path):
    written = []
    for count in (1, 4):
        use_threads(count)
        path = tmp_path / f"{count}.stl"
        stl.write_stl(mesh, path)
        written.append(path.read_bytes())
    assert written[0] == written[1]


@pytest.mark.parametrize("count", [1, 3])
def test_portions_come_in_their_order_and_only_a_few_are_made_ahead(count):
    use_threads(count)
    asked = []

    def portions():
        for k in range(100):
            asked.append(k)
            yield k

    given = in_threads(lambda k: k * k, portions())
    assert next(given) == 0
    assert len(asked) <= 2 * count + 1
    assert list(given) == [k * k for k in range(1, 100)]


def test_what_goes_wrong_in_a_thread_is_raised_where_it_is_asked_for():
    given = in_threads(lambda k: 1 // (k - 2), range(5))
    assert [next(given), next(given)] == [-1, -1]
    with pytest.raises(ZeroDivisionError):
        next(given)
