# SPDX-License-Identifier: LGPL-2.1-or-later
"""Other programs end when they are done, or when the user cancels."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from volfrep.process.child import Limits, OverLimit
from volfrep.process.programs import FREECAD_PLACES, find_freecad, run_program
from volfrep.util.errors import Cancelled
from volfrep.util.progress import Monitor


def test_what_it_says_is_kept(tmp_path: Path):
    script = "import os, sys; print(os.getcwd(), flush=True); sys.exit('bad')"
    done = run_program([sys.executable, "-c", script], tmp_path)
    assert done.returncode == 1
    assert done.stdout.split() == [str(tmp_path), "bad"]


#: A program whose file grows for as long as it runs.
GROWING = """
import time
with open("on", "ab", buffering=0) as on:
    while True:
        on.write(b".")
        time.sleep(0.01)
"""


def grows(path: Path) -> bool:
    """Whether a file grows within half a second."""
    before = path.stat().st_size
    time.sleep(0.5)
    return path.stat().st_size > before


def test_a_cancelled_program_is_ended(tmp_path: Path):
    on, seen = tmp_path / "on", []

    def cancel_once_it_grows(*_: object) -> bool:
        seen.append(on.exists() and grows(on))
        return not seen[-1]

    with pytest.raises(Cancelled):
        run_program([sys.executable, "-c", GROWING], tmp_path, Monitor(cancel_once_it_grows))
    assert seen[-1]
    assert not grows(on)


def test_a_program_that_takes_too_long_is_ended(tmp_path: Path):
    with pytest.raises(OverLimit):
        run_program([sys.executable, "-c", GROWING], tmp_path, limits=Limits(seconds=2.0))
    assert (tmp_path / "on").stat().st_size > 0
    assert not grows(tmp_path / "on")


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such limit")
def test_processor_seconds_pass_only_while_a_program_works(tmp_path: Path):
    limits = Limits(seconds=60.0, processor_seconds=1.0)
    assert run_program(["sleep", "1.2"], tmp_path, limits=limits).returncode == 0
    with pytest.raises(OverLimit, match="processor time"):
        run_program(["sh", "-c", "while :; do :; done"], tmp_path, limits=limits)
    assert not list(tmp_path.iterdir())


#: A program that starts another one, and leaves both numbers.
FAMILY = """
import os, subprocess, sys, time
other = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
open("being", "w").write(f"{os.getpid()} {other.pid}")
os.rename("being", "on")
time.sleep(600)
"""


def ends(number: int, seconds: float = 60.0) -> bool:
    """Whether a process ends within so many seconds."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            state = Path("/proc", str(number), "stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            return True
        if state == "Z":
            return True
        time.sleep(0.01)
    os.kill(number, signal.SIGKILL)
    return False


@pytest.mark.skipif(sys.platform != "linux", reason="asks /proc")
@pytest.mark.parametrize("name", ["plain", "Größe und 部品 'a'"])
def test_what_a_program_has_started_ends_with_it(name: str, tmp_path: Path):
    folder = tmp_path / name
    folder.mkdir()
    on = folder / "on"
    with pytest.raises(Cancelled):
        run_program([sys.executable, "-c", FAMILY], folder, Monitor(lambda *_: not on.exists()))
    for number in on.read_text().split():
        assert ends(int(number))


@pytest.mark.skipif(sys.platform != "linux", reason="asks /proc")
def test_a_program_ends_when_the_process_that_runs_it_is_killed(tmp_path: Path):
    code = (
        f"import sys; sys.path[:0] = {sys.path!r}\n"
        "from pathlib import Path\n"
        "from volfrep.process.programs import run_program\n"
        f"run_program([sys.executable, '-c', {FAMILY!r}], Path({str(tmp_path)!r}))\n"
    )
    runs = subprocess.Popen([sys.executable, "-c", code])
    while not (tmp_path / "on").exists():
        assert runs.poll() is None
        time.sleep(0.01)
    runs.kill()
    runs.wait()
    for number in (tmp_path / "on").read_text().split():
        assert ends(int(number))


def test_a_program_that_is_not_there_is_told(tmp_path: Path):
    with pytest.raises(OSError, match="no such program"):
        run_program([str(tmp_path / "no such program")], tmp_path)


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
    monkeypatch.setattr("volfrep.process.programs.shutil.which", lambda name: None)
    assert find_freecad() == str(tmp_path / "FreeCAD 1.1" / "bin" / "freecadcmd.exe")
