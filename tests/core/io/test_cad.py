# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading a CAD file can be cancelled while FreeCAD is at it; tests/freecad reads real ones."""

import os
import sys
import time
from pathlib import Path

import pytest

import volfrep
from volfrep.util.errors import Cancelled

#: Stands for FreeCAD: at a file that takes long.
SLOW = """#!{python}
import os, time
with open({pid!r}, "w") as file:
    file.write(str(os.getpid()))
os.rename({pid!r}, {on!r})
time.sleep(60)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="a script is no program there")
@pytest.mark.parametrize("call", ["fill", "slice_layers"])
def test_a_cancel_ends_freecad(call: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    program, on = tmp_path / "freecadcmd", tmp_path / "on"
    program.write_text(SLOW.format(python=sys.executable, pid=str(tmp_path / "being"), on=str(on)))
    program.chmod(0o755)
    monkeypatch.setenv("VOLFREP_FREECAD", str(program))
    part = tmp_path / "part.brep"
    part.write_text("DBRep_DrawableShape\n")
    stages = []

    def cancel_once_it_runs(fraction: float, stage: str) -> bool:
        stages.append(stage)
        return not on.exists()

    more = {"folder": tmp_path / "layers", "layer": 1.0} if call == "slice_layers" else {}
    start = time.monotonic()
    with pytest.raises(Cancelled):
        getattr(volfrep, call)(part, progress=cancel_once_it_runs, **more)
    assert time.monotonic() - start < 30
    assert set(stages) == {"reading"}
    with pytest.raises(OSError, match=r"[Nn]o such process"):
        os.kill(int(on.read_text()), 0)
