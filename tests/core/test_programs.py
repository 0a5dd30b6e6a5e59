# SPDX-License-Identifier: LGPL-2.1-or-later
"""Other programs end when they are done, or when the user cancels."""

import os
import sys
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
    script = (
        "import os, pathlib, time; pathlib.Path('being').write_text(str(os.getpid()))\n"
        "os.rename('being', 'on'); time.sleep(600)"
    )

    def cancel_once_it_runs(*_: object) -> bool:
        return not (tmp_path / "on").exists()

    with pytest.raises(Cancelled):
        run_program([sys.executable, "-c", script], tmp_path, Monitor(cancel_once_it_runs))
    with pytest.raises(OSError, match=r"[Nn]o such process|[Pp]arameter"):
        os.kill(int((tmp_path / "on").read_text()), 0)
