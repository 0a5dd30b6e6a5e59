# SPDX-License-Identifier: LGPL-2.1-or-later
"""Without a screen a job is a call."""

import os
import threading

import FreeCAD as App
import Part
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.deps import python_executable
from freecad_volfrep.engines import freecads, programs
from freecad_volfrep.features.jobs.job import Job, State
from freecad_volfrep.features.jobs.progress import run_job
from freecad_volfrep.features.jobs.screen import is_asked_by_user
from freecad_volfrep.preferences import THREADS, write
from volfrep.jobs import workers
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.process.engines import Engines
from volfrep.process.worker import Call
from volfrep.process.worker import this_python as beside
from volfrep.util.errors import VolfrepError
from volfrep.util.threads import threads


def tell(sentence, *, progress):
    if sentence:
        raise VolfrepError(sentence)
    return threading.current_thread(), progress


def test_without_a_screen_a_job_is_called_where_it_is_asked_for():
    assert not App.GuiUp
    thread, progress = run_job("A job", tell, "")
    assert thread is threading.current_thread()
    assert progress is None


def test_what_a_job_raises_arrives():
    with pytest.raises(VolfrepError, match="This job fails"):
        run_job("A job", tell, "This job fails.")


def test_the_processes_of_the_window_find_the_engine():
    """The Python beside FreeCAD, and FreeCAD without windows, which is the next best."""
    found = programs(1)
    assert len(found) == 2
    for program in found:
        missed = []
        engine = Engines([program], missed.append)
        number = engine.begin(Call(os.getpid, has_progress=False)).result()
        threads_there = engine.begin(Call(threads, has_progress=False)).result()
        engine.end()
        assert missed == []
        assert number != os.getpid()
        assert threads_there == 1


def test_a_large_recompute_has_workers_that_stay_as_many_as_threads_are_preferred(
    doc, box, monkeypatch
):
    monkeypatch.setattr(workers, "WORTH_WORKER", 1)
    obj = make_lattice_infill(doc, box, **SMALL)
    doc.recompute()
    with workers.kept_workers(2) as kept:
        assert kept.elsewhere(os.getpid).result() in {each.number for each in kept.workers}
        program = kept.elsewhere(beside).result()
    assert program.command == (python_executable(),), "not this FreeCAD, which opens a window"
    write(THREADS, 1)
    try:
        obj.StrutRadius = 0.9
        doc.recompute()
        assert kept.is_open, "nobody has asked for workers"
    finally:
        write(THREADS, THREADS.default)
        workers.end_kept_workers()
    assert not any(each.is_alive for each in kept.workers)


@pytest.mark.costly
def test_a_shape_is_made_in_a_freecad_of_its_own():
    """Without a word of ours on the way, and the same as here; an error arrives as it is."""
    from freecad_volfrep.bridge.faceted import faceted_solid
    from freecad_volfrep.bridge.solids import mesh_of_shape
    from freecad_volfrep.bridge.worker_calls import packed_facets, unpack

    mesh = mesh_of_shape(Part.makeBox(1, 2, 3), "Box")
    there = freecads().begin(Call(packed_facets, (mesh,), has_progress=False))
    open_mesh = TriangleMesh(mesh.vertices, mesh.triangles[1:])
    failed = freecads().begin(Call(packed_facets, (open_mesh,), has_progress=False))
    shape = unpack(there.result())
    assert shape.isValid()
    assert shape.Volume == faceted_solid(mesh).Volume
    with pytest.raises(VolfrepError, match="closed"):
        failed.result()


def test_a_recompute_of_the_users_is_told_from_a_scripts():
    """A command of FreeCAD's window is a line of text; a script stands in a file."""
    asked = []

    class Proxy:
        def execute(self, _):
            asked.append(is_asked_by_user())

    proxy = Proxy()
    proxy.execute(None)
    exec(compile("proxy.execute(None)", "<string>", "exec"), {"proxy": proxy})
    assert asked == [False, True]


def test_a_job_goes_from_state_to_state_and_no_other_way():
    job = Job("A job", Call(tell, ("",)))
    assert job.state is State.WAITING
    for state in (State.RUNNING, State.CANCELLING, State.ARRIVING):
        job.go(state)
        assert job.is_under_way
    job.go(State.CANCELLED)
    assert not job.is_under_way
    with pytest.raises(ValueError, match="a job that is cancelled cannot be running next"):
        job.go(State.RUNNING)
    assert Job().state is State.IDLE
