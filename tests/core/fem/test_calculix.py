# SPDX-License-Identifier: LGPL-2.1-or-later
"""CalculiX as it is run: what is said where it fails."""

import os
import shutil
from pathlib import Path

import pytest

from volfrep import VolfrepError
from volfrep.fem.calculix import solve

needs_calculix = pytest.mark.skipif(
    shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed"
)


@needs_calculix
def test_calculix_says_what_is_wrong(tmp_path: Path):
    (tmp_path / "bad.inp").write_text("*NODE\n1,0,0,0\n*STEP\n*STATIC\n*END STEP\n")
    with pytest.raises(VolfrepError, match="did not solve"):
        solve(tmp_path / "bad.inp")


def test_without_calculix(tmp_path: Path, monkeypatch):
    (tmp_path / "any.inp").touch()
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(VolfrepError, match="not installed"):
        solve(tmp_path / "any.inp")


@pytest.mark.skipif(os.name == "nt", reason="a program as a script")
def test_calculix_is_ended_when_its_time_is_over(tmp_path: Path, monkeypatch):
    program = tmp_path / "ccx"
    program.write_text("#!/bin/sh\nexec /bin/sleep 60\n")
    program.chmod(0o755)
    (tmp_path / "any.inp").touch()
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(VolfrepError, match=r"within 0\.2 s"):
        solve(tmp_path / "any.inp", seconds=0.2)
