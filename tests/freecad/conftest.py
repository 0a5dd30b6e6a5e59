# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests inside FreeCAD share: a document, a box in it, and small quick lattices."""

import os
import subprocess
import sys
from pathlib import Path

import FreeCAD as App
import pytest

from freecad_volfrep import make_lattice_infill
from freecad_volfrep.compat import package_folder
from freecad_volfrep.engine import require_engine

ROOT = Path(__file__).resolve().parents[2]
#: A lattice that is quick to compute.
SMALL = {"CellSize": 10, "StrutRadius": 1, "ShellThickness": 2, "Resolution": 10}


def top_of(box):
    """The name of the highest face."""
    faces = box.Shape.Faces
    return f"Face{1 + max(range(len(faces)), key=lambda k: faces[k].CenterOfMass.z)}"


def said_without_packages(folder, body, but_for=None):
    """The lines that a script prints, by their first words, in a FreeCAD without our packages.

    `folder` becomes its profile. The test is skipped where they are installed for everybody.

    Args:
        folder: empty.
        body: of the script.
        but_for: the package that is missing; None for all.
    """
    (folder / "Mod").mkdir()
    (folder / "Mod" / "VOLFREP").symlink_to(ROOT)
    if but_for is not None:
        user = App.getUserAppDataDir()
        there = folder / package_folder().relative_to(user)
        there.mkdir(parents=True)
        for package in Path(user, "AdditionalPythonPackages").iterdir():
            if not package.name.startswith((but_for, "__editable__")):
                (there / package.name).symlink_to(package.resolve())
    script = folder / "script.py"
    script.write_text(
        "import os, sys, FreeCAD as App\n"
        "from freecad_volfrep.deps import missing_optional, missing_packages\n"
        "print('MISSING', [*missing_packages(), *missing_optional()])\n"
        + body
        + "sys.stdout.flush()\nos._exit(0)\n"
    )
    environment = dict(os.environ, FREECAD_USER_HOME=str(folder), PYTHONPATH="")
    done = subprocess.run(
        [sys.executable, str(script)], env=environment, capture_output=True, text=True, timeout=600
    )
    lines = {line.split(" ", 1)[0]: line for line in done.stdout.splitlines()}
    assert "MISSING" in lines, done.stdout + done.stderr
    if lines["MISSING"] == "MISSING []":
        pytest.skip("this FreeCAD has the engine's packages installed system-wide")
    return lines


@pytest.fixture
def doc():
    document = App.newDocument("VolfrepTest")
    document.UndoMode = 1
    yield document
    App.closeDocument(document.Name)


@pytest.fixture
def box(doc):
    solid = doc.addObject("Part::Box", "Solid")
    solid.Length, solid.Width, solid.Height = 30, 20, 20
    doc.recompute()
    return solid


@pytest.fixture
def infill(doc, box):
    """A computed lattice infill of the box."""
    obj = make_lattice_infill(doc, box, **SMALL)
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    return obj


@pytest.fixture(scope="session", autouse=True)
def kept_fills():
    """What a new object asks for is filled once in all tests: many begin with the same lattice.

    A fill with a cache of its own that holds nothing yet, and that nobody follows, is kept with
    what it left in the cache; all others, such as an object's second one, are done. Of what is done
    before and after it, which follows from a mesh and a specification alone, answers are kept.
    """
    require_engine()
    sys.path.append(str(ROOT / "tests" / "core"))
    import shared_stages
    from volfrep.jobs import pipeline
    from volfrep.util.content import content_of

    shared_stages.share()

    kept, fill = {}, pipeline.fill

    def once(solid, spec, *, progress=None, cache=None, executor=None):
        if progress is not None or executor is not None or cache is None or cache._entries:
            return fill(solid, spec, progress=progress, cache=cache, executor=executor)
        asked = content_of(solid.vertices, solid.triangles), solid.notes, spec
        if asked not in kept:
            kept[asked] = fill(solid, spec, cache=cache), dict(cache._entries)
        result, entries = kept[asked]
        cache._entries.update(entries)
        return result

    def answers(function):
        of = {}

        def answer(*given):
            key = tuple(
                content_of(one.vertices, one.triangles) if hasattr(one, "triangles") else one
                for one in given
            )
            if key not in of:
                of[key] = function(*given)
            return of[key]

        return answer

    patch = pytest.MonkeyPatch()
    patch.setattr(pipeline, "fill", once)
    for function in (pipeline.check_solid, pipeline.forecast_fill, pipeline.kinds_of_triangles):
        patch.setattr(pipeline, function.__name__, answers(function))
    yield
    patch.undo()


@pytest.fixture
def runs(monkeypatch):
    """The specifications that the engine has been run with since the test began."""
    require_engine()
    import volfrep.jobs.pipeline

    specs = []
    fill = volfrep.jobs.pipeline.fill

    def counting(solid, spec, **options):
        specs.append(spec)
        return fill(solid, spec, **options)

    monkeypatch.setattr(volfrep.jobs.pipeline, "fill", counting)
    return specs
