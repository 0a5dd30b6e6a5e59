# SPDX-License-Identifier: LGPL-2.1-or-later
"""Other programs end when they are done, or when the user cancels."""

import sys
import time
from pathlib import Path

import pytest

from volfrep.errors import Cancelled
from volfrep.programs import run_program
from volfrep.progress import Monitor


def test_what_it_says_is_kept(tmp_path: Path):
    script = "import os, sys; print(os.getcwd(), flush=True); sys.exit('bad')"
    done = run_program([sys.executable, "-c", script], tmp_path)
    assert done.returncode == 1
    assert done.stdout.split() == [str(tmp_path), "bad"]


def test_a_cancelled_program_is_ended(tmp_path: Path):
    script = f"import time; open({str(tmp_path / 'on')!r}, 'w'); time.sleep(60)"
    start = time.perf_counter()

    def cancel_once_it_runs(*_: object) -> bool:
        return not (tmp_path / "on").exists()

    with pytest.raises(Cancelled):
        run_program([sys.executable, "-c", script], tmp_path, Monitor(cancel_once_it_runs))
    assert time.perf_counter() - start < 20
