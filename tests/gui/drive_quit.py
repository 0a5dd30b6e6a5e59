# SPDX-License-Identifier: LGPL-2.1-or-later
"""Quitting FreeCAD with lattice infills open, by key, menu and window; see tools/run_gui.sh.

Each check starts a FreeCAD of its own (quitting.py) on the same screen, with a profile of its own:
it has to end with 0 and to leave nothing behind that its next start would offer to recover.
"""

import os
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import NamedTuple

import FreeCADGui as Gui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import PATIENCE, check, comes_true, costly, run_checks, shoot

_SCRIPT = Path(__file__).with_name("quitting.py")


def _quit(open_, by, *answers):
    """Quit another FreeCAD; returns what its files hold, by their names."""
    home = Path(os.environ["FREECAD_USER_HOME"])
    with tempfile.TemporaryDirectory() as folder:
        own = Path(folder)
        for name in ("Mod", "AdditionalPythonPackages"):
            (own / name).symlink_to(home / name)
        (own / "tmp").mkdir()
        _start_and_quit(own, open_, by, answers)
        left = [path.name for path in own.rglob("FreeCAD_Doc_*")]
        check("nothing is left to recover", left == [], left)
        check("no process of the engine is left", comes_true(lambda: not _engines(own), 10))
        return {path.stem: _held(path) for path in own.glob("*.FCStd")}


def _start_and_quit(own, open_, by, answers):
    """Start FreeCAD with a profile, and see it end well."""
    asked = {"QUIT_OPEN": open_, "QUIT_BY": by, "QUIT_ANSWERS": " ".join(answers)}
    where = {"FREECAD_USER_HOME": own, "TMPDIR": own / "tmp", "XDG_CACHE_HOME": own}
    Gui.getMainWindow().hide()  # the other one's comes to lie where this one is
    with (own / "said").open("w+", encoding="utf-8") as said:
        other = subprocess.Popen(
            ["freecad", str(_SCRIPT)],
            env={**os.environ, **asked, **where},
            stdout=said,
            stderr=subprocess.STDOUT,
        )
        if not comes_true(lambda: other.poll() is not None, 2 * PATIENCE):
            shoot(f"quit_{open_}")
            other.kill()
            other.wait()
        Gui.getMainWindow().show()
        said.seek(0)
        check(
            f"quitting {open_} by {by} ends with 0",
            other.returncode == 0,
            f"{other.returncode}: {said.read()[-1500:]}",
        )


def _engines(own):
    """What is left of the engine's processes and their folders."""
    running = []
    for line in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            running += [line.parent.name] if str(own).encode() in line.read_bytes() else []
        except OSError:  # it has ended meanwhile
            continue
    return running + list(own.rglob("volfrep-engine-*"))


class _Held(NamedTuple):
    """What a file holds: bytes of meshes, and the text that has all other values."""

    meshes: int = 0
    values: str = ""


def _held(path):
    with zipfile.ZipFile(path) as file:
        check(f"{path.name} is whole", file.testzip() is None)
        sizes = [part.file_size for part in file.infolist() if part.filename.endswith(".bms")]
        return _Held(sum(sizes), file.read("Document.xml").decode())


def _radii(held):
    found = re.findall(r'"StrutRadius"[^>]*>\s*<Float value="(.*?)"', held.values)
    return [float(radius) for radius in found]


@costly
def by_key():
    """One document, saved."""
    held = _quit("one", "key", "Discard").get("One", _Held())
    check("the mesh is in the file", held.meshes > 1000)


@costly
def several_documents_by_menu():
    """Also a mesh that was imported and one that was read in the Python console."""
    files = _quit("several", "menu", "Discard", "Discard", "Discard")
    check("all files are there", set(files) == {"First", "Second", "Third"}, files)


def during_a_job_by_window():
    """A job beside the user: FreeCAD asks, and the mesh of before is saved with the new values."""
    held = _quit("job", "window", "Save").get("Job", _Held())
    check("the mesh is in the file", held.meshes > 1000)
    check("it is asked and saved", 1.2 in _radii(held), _radii(held))


@costly
def while_loads_are_picked():
    """What is made ahead of a sizing ends with FreeCAD; the file is as it was."""
    held = _quit("picking", "window", "Discard").get("Picking", _Held())
    check("the mesh is in the file", held.meshes > 1000)
    check("no load is", "Fem::" not in held.values)


@costly
def during_a_job_that_is_waited_for():
    """The same of a job that a script waits for, which is cancelled first."""
    held = _quit("waited_for", "window", "Save").get("Waited", _Held())
    check("the mesh is in the file", held.meshes > 1000)
    check("it is asked and saved", 1.2 in _radii(held), _radii(held))


@costly
def after_undo():
    """Nothing was saved, and it is discarded."""
    check("no file", _quit("undone", "key", "Discard") == {})


@costly
def cancel_and_save():
    """FreeCAD asks; Cancel loses nothing, and what was done after it is saved."""
    held = _quit("unsaved", "window", "Cancel", "Save").get("Unsaved", _Held())
    check("the mesh is in the file", held.meshes > 1000)
    check("what came later, too", 'name="Later"' in held.values)


run_checks(
    "quit",
    {
        by_key: None,
        several_documents_by_menu: None,
        during_a_job_by_window: None,
        while_loads_are_picked: None,
        during_a_job_that_is_waited_for: None,
        after_undo: None,
        cancel_and_save: None,
    },
)
