# SPDX-License-Identifier: LGPL-2.1-or-later
"""Without a screen a job is a call."""

import threading

import FreeCAD as App
import pytest

from freecad_volfrep.features.progress import progress_of, run_job
from volfrep.util.errors import VolfrepError


def test_without_a_screen_a_job_is_called_where_it_is_asked_for():
    assert not App.GuiUp
    thread, progress = run_job("A job", lambda progress: (threading.current_thread(), progress))
    assert thread is threading.current_thread()
    assert progress is None


def test_what_a_job_raises_arrives():
    def fail(progress):
        raise VolfrepError("This job fails.")

    with pytest.raises(VolfrepError, match="This job fails"):
        run_job("A job", fail)


def test_without_a_screen_there_is_no_progress():
    with progress_of("A job") as progress:
        assert progress is None
