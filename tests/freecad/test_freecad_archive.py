# SPDX-License-Identifier: LGPL-2.1-or-later
"""The add-on's archive, unpacked into a clean profile: it fills, and documents open both ways."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import FreeCAD as App
import pytest

from freecad_volfrep.features.infill.lattice_infill import UP_TO_DATE, LatticeInfill

ROOT = Path(__file__).resolve().parents[2]
#: Fills a box, saves it, and opens what another way of installing saved.
SCRIPT = """import os, sys, FreeCAD as App
import freecad.volfrep
from freecad.volfrep import make_lattice_infill
print("HOME", freecad.volfrep.__file__)
doc = App.newDocument("A")
box = doc.addObject("Part::Box", "Solid")
box.Length, box.Width, box.Height = 30, 20, 20
doc.recompute()
lattice = make_lattice_infill(
    doc, box, CellSize=10, StrutRadius=1, ShellThickness=2, Resolution=10
)
doc.recompute()
print("MADE", lattice.isValid(), lattice.Mesh.isSolid(), lattice.Status)
doc.saveAs({made!r})
other = App.openDocument({other!r})
print("OTHER", *(f"{{type(o.Proxy).__module__}} {{o.Status}}" for o in other.Objects
                if hasattr(o, "Proxy")))
try:
    import volfrep
    print("LEAK", volfrep.__file__)
except ModuleNotFoundError:
    print("LEAK none")
sys.stdout.flush()
os._exit(0)
"""


@pytest.fixture(scope="module")
def profile(tmp_path_factory):
    """A profile that holds nothing but the unpacked archive, and the packages."""
    home = tmp_path_factory.mktemp("profile")
    made = tmp_path_factory.mktemp("release") / "VOLFREP"
    # An environment's own Python knows the engine; the archive must not need it.
    subprocess.run(
        [ROOT / ".venv" / "bin" / "python", ROOT / "tools" / "addon_archive.py", made], check=True
    )
    (archive,) = made.parent.glob("*.zip")
    with zipfile.ZipFile(archive) as file:
        file.extractall(home / "Mod" / "VOLFREP")
    user = Path(os.environ.get("FREECAD_USER_HOME", App.getUserAppDataDir()))
    packages = user / "AdditionalPythonPackages"
    (home / "AdditionalPythonPackages").symlink_to(packages.resolve())
    return home


@pytest.mark.slow
def test_the_archive_fills_and_documents_open_both_ways(doc, infill, profile, tmp_path):
    mine, made = tmp_path / "checkout.FCStd", tmp_path / "archive.FCStd"
    doc.saveAs(str(mine))
    script = tmp_path / "script.py"
    script.write_text(SCRIPT.format(made=str(made), other=str(mine)), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, str(script)],
        env=dict(os.environ, FREECAD_USER_HOME=str(profile), PYTHONPATH=""),
        capture_output=True, text=True, timeout=300,
    )  # fmt: skip
    said = {line.split(" ", 1)[0]: line for line in done.stdout.splitlines() if " " in line}
    assert str(profile) in said["HOME"], done.stdout + done.stderr
    assert said["MADE"] == f"MADE True True {UP_TO_DATE}"
    assert said["OTHER"] == f"OTHER freecad.volfrep.features {UP_TO_DATE}"
    assert said["LEAK"] == "LEAK none"
    again = App.openDocument(str(made))
    try:
        (obj,) = [obj for obj in again.Objects if hasattr(obj, "Proxy")]
        assert isinstance(obj.Proxy, LatticeInfill)
        assert obj.Status == UP_TO_DATE
    finally:
        App.closeDocument(again.Name)
