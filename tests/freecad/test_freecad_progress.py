# SPDX-License-Identifier: LGPL-2.1-or-later
"""Without a screen a job is a call."""

import os
import threading

import FreeCAD as App
import pytest

from freecad_volfrep.engines import programs
from freecad_volfrep.features.progress import progress_of, run_job
from volfrep.apart.engine_process import Call
from volfrep.apart.engines import Engines
from volfrep.util.errors import VolfrepError
from volfrep.util.threads import threads


def tell(sentence, *, progress):
    if sentence:
        raise VolfrepError(sentence)
    return threading.current_thread(), progress


def test_without_a_screen_a_job_is_called_where_it_is_asked_for():
    assert not App.GuiUp
    thread, progress = run_job("A job", Call(tell, ("",)))
    assert thread is threading.current_thread()
    assert progress is None


def test_what_a_job_raises_arrives():
    with pytest.raises(VolfrepError, match="This job fails"):
        run_job("A job", Call(tell, ("This job fails.",)))


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


def test_without_a_screen_there_is_no_progress():
    with progress_of("A job") as progress:
        assert progress is None
