# SPDX-License-Identifier: LGPL-2.1-or-later
"""Other programs end when they are done, or when the user cancels."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from volfrep.util.errors import Cancelled
from volfrep.util.progress import Monitor
from volfrep.util.subprocesses import FREECAD_PLACES, find_freecad, run_program


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


def test_a_program_that_takes_too_long_is_ended(tmp_path: Path):
    script = (
        "import os, pathlib, time; pathlib.Path('on').write_text(str(os.getpid())); time.sleep(600)"
    )
    with pytest.raises(subprocess.TimeoutExpired):
        run_program([sys.executable, "-c", script], tmp_path, seconds=2.0)
    with pytest.raises(OSError, match=r"[Nn]o such process|[Pp]arameter"):
        os.kill(int((tmp_path / "on").read_text()), 0)


def test_freecad_is_named_by_a_variable_or_found_on_the_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    program = tmp_path / "freecadcmd"
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(sys, "platform", "a system of which nothing is known")
    monkeypatch.delenv("VOLFREP_FREECAD", raising=False)
    assert find_freecad() is None
    program.touch(0o755)
    assert find_freecad() == str(program)
    monkeypatch.setenv("VOLFREP_FREECAD", str(tmp_path / "missing"))
    assert find_freecad() is None


def test_freecad_is_found_where_installers_put_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("VOLFREP_FREECAD", raising=False)
    for version in ("1.0", "1.1"):
        place = tmp_path / f"FreeCAD {version}" / "bin"
        place.mkdir(parents=True)
        (place / "freecadcmd.exe").touch()
    monkeypatch.setattr(sys, "platform", "win32")
    pattern = FREECAD_PLACES["win32"][1]
    monkeypatch.setitem(FREECAD_PLACES, "win32", (str(tmp_path), pattern))
    # Of the test's own system, whose `which` wants no Windows.
    monkeypatch.setattr("volfrep.util.subprocesses.shutil.which", lambda name: None)
    assert find_freecad() == str(tmp_path / "FreeCAD 1.1" / "bin" / "freecadcmd.exe")
