# SPDX-License-Identifier: LGPL-2.1-or-later
"""Quitting FreeCAD with lattice infills open, by key, menu and window; see tools/run_gui.sh.

Each check starts a FreeCAD of its own (quitting.py) on the same screen, with a profile of its own:
it has to end with 0 and to leave nothing behind that its next start would offer to recover.
"""

import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import FreeCADGui as Gui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import PATIENCE, check, comes_true, run_checks

_SCRIPT = Path(__file__).with_name("quitting.py")


def _quit(open_, by, *answers):
    """Quit another FreeCAD; returns how many triangles' bytes each file of it has, by its name."""
    home = Path(os.environ["FREECAD_USER_HOME"])
    with tempfile.TemporaryDirectory() as folder:
        own = Path(folder)
        for name in ("Mod", "AdditionalPythonPackages"):
            (own / name).symlink_to(home / name)
        (own / "tmp").mkdir()
        asked = {"QUIT_OPEN": open_, "QUIT_BY": by, "QUIT_ANSWERS": " ".join(answers)}
        where = {"FREECAD_USER_HOME": folder, "TMPDIR": f"{folder}/tmp", "XDG_CACHE_HOME": folder}
        Gui.getMainWindow().hide()  # the other one's comes to lie where this one is
        with (own / "said").open("w+", encoding="utf-8") as said:
            other = subprocess.Popen(
                ["freecad", str(_SCRIPT)],
                env={**os.environ, **asked, **where},
                stdout=said,
                stderr=subprocess.STDOUT,
            )
            if not comes_true(lambda: other.poll() is not None, 2 * PATIENCE):
                other.kill()
                other.wait()
            Gui.getMainWindow().show()
            said.seek(0)
            check(
                f"quitting by {by} ends with 0",
                other.returncode == 0,
                f"{other.returncode}: {said.read()[-1500:]}",
            )
        left = [path.name for path in own.rglob("FreeCAD_Doc_*")]
        check("nothing is left to recover", left == [], left)
        return {path.stem: _mesh_bytes(path) for path in own.glob("*.FCStd")}


def _mesh_bytes(path):
    with zipfile.ZipFile(path) as file:
        sizes = [part.file_size for part in file.infolist() if part.filename.endswith(".bms")]
        check(f"{path.name} is whole", file.testzip() is None)
    return sum(sizes)


def by_key():
    """One document, saved."""
    check("the mesh is in the file", _quit("one", "key", "Discard").get("One", 0) > 1000)


def several_documents_by_menu():
    """Also a mesh that was imported and one that was read in the Python console."""
    files = _quit("several", "menu", "Discard", "Discard", "Discard")
    check("all files are there", set(files) == {"First", "Second", "Third"}, files)


def during_a_job_by_window():
    """The mesh of before stays in the file."""
    check("the mesh is in the file", _quit("job", "window", "Discard").get("Job", 0) > 1000)


def after_undo():
    """Nothing was saved, and it is discarded."""
    check("no file", _quit("undone", "key", "Discard") == {})


def cancel_and_save():
    """FreeCAD asks; Cancel loses nothing, and what was done after it is saved."""
    files = _quit("unsaved", "window", "Cancel", "Save")
    check("the mesh is in the file", files.get("Unsaved", 0) > 1000, files)


run_checks(
    "quit",
    {
        by_key: None,
        several_documents_by_menu: None,
        during_a_job_by_window: None,
        after_undo: None,
        cancel_and_save: None,
    },
)
