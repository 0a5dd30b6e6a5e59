# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents that a FreeCAD without the workbench has saved, that are damaged, or are too new."""

import os
import shutil
import subprocess
import sys
import zipfile

import FreeCAD as App
import pytest

from freecad_volfrep import make_print_check
from freecad_volfrep.features import LatticeInfill, PrintCheck
from freecad_volfrep.features.infill.lattice_infill import REVIVED, UP_TO_DATE
from freecad_volfrep.features.infill.properties import SCHEMA_VERSION, SPOILED
from freecad_volfrep.revival import revive

PROXY = 'module="freecad.volfrep.features" class="LatticeInfill"'


@pytest.fixture
def opened():
    """Opens documents, and closes them again."""
    names = []

    def open_document(path):
        names.append(App.openDocument(str(path)).Name)
        return App.getDocument(names[-1])

    yield open_document
    for name in names:
        App.closeDocument(name)


def saved_without_the_workbench(path, folder, body=""):
    """Open and save a document in a FreeCAD of an empty profile, which knows nothing of ours."""
    script = folder / "script.py"
    script.write_text(
        "import os, sys, FreeCAD as App\n"
        f"doc = App.openDocument({str(path)!r})\n"
        "print('PROXY', doc.LatticeInfill.Proxy)\n" + body + "doc.save()\n"
        "sys.stdout.flush()\n"
        "os._exit(0)\n"
    )
    environment = dict(os.environ, FREECAD_USER_HOME=str(folder / "home"), PYTHONPATH="")
    (folder / "home").mkdir()
    done = subprocess.run(
        [sys.executable, str(script)], env=environment, capture_output=True, text=True, timeout=600
    )
    assert "PROXY None" in done.stdout, done.stdout + done.stderr


def rewritten(doc, path, *changes):
    """A copy of a document with texts of its Document.xml replaced, each of which must be there."""
    whole = path.with_name("whole.FCStd")
    doc.saveCopy(str(whole))
    with zipfile.ZipFile(whole) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            data = old.read(name)
            if name == "Document.xml":
                for text, other in changes:
                    assert text.encode() in data, text
                    data = data.replace(text.encode(), other.encode())
            new.writestr(name, data)
    return path


def test_what_another_freecad_saved_is_alive_again(doc, infill, tmp_path, opened, runs):
    check = make_print_check(doc, infill)
    doc.recompute()
    path = tmp_path / "part.FCStd"
    doc.saveCopy(str(path))
    saved_without_the_workbench(path, tmp_path)
    again = opened(path)
    obj, checked = again.getObject(infill.Name), again.getObject(check.Name)
    assert isinstance(obj.Proxy, LatticeInfill)
    assert isinstance(checked.Proxy, PrintCheck)
    assert obj.Status == REVIVED
    again.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert checked.isValid(), checked.getStatusString()
    assert obj.Status == UP_TO_DATE
    assert [spec for spec in runs if spec.output == "part"] == [], "nothing had changed"
    before = obj.Mesh.Volume
    obj.StrutRadius = 0.8
    again.recompute()
    assert obj.Status == UP_TO_DATE
    assert obj.Mesh.Volume < before
    assert len([spec for spec in runs if spec.output == "part"]) == 1
    again.save()
    assert isinstance(opened(shutil.copy(path, tmp_path / "b.FCStd")).getObject(infill.Name).Proxy,
                      LatticeInfill)  # fmt: skip


@pytest.mark.slow
def test_what_was_changed_there_is_followed(doc, infill, tmp_path, opened):
    path = tmp_path / "part.FCStd"
    doc.saveCopy(str(path))
    saved_without_the_workbench(
        path,
        tmp_path,
        "doc.LatticeInfill.StrutRadius = 0.7\n"
        "doc.Solid.Length = 40\n"
        "doc.recompute()\n"
        "assert doc.LatticeInfill.Status == 'Up to date'\n"
        "assert 'Touched' not in doc.LatticeInfill.State\n",
    )
    again = opened(path)
    again.recompute()
    obj = again.getObject(infill.Name)
    assert obj.Status == UP_TO_DATE
    assert obj.Mesh.BoundBox.XMax == pytest.approx(40)
    assert obj.StrutRadii == pytest.approx([0.7, 0.7])


@pytest.mark.parametrize(
    "proxy",
    [
        "",
        'module="freecad.volfrep.features" class="LatticeInfil"',
        'module="no_such_module" class="LatticeInfill"',
        'module="freecad.volfrep.features" class="PrintCheck"',
        'module="argparse" class="Namespace"',
    ],
)
def test_a_damaged_or_a_foreign_proxy_is_replaced(doc, infill, tmp_path, opened, proxy):
    again = opened(rewritten(doc, tmp_path / "bad.FCStd", (PROXY, proxy)))
    obj = again.getObject(infill.Name)
    assert isinstance(obj.Proxy, LatticeInfill)
    assert obj.Status == REVIVED
    obj.StrutRadius = 0.8
    again.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert obj.Status == UP_TO_DATE
    assert obj.StrutRadii == pytest.approx([0.8, 0.8])


def test_a_proxy_without_its_state_is_used_as_it_is(doc, infill, tmp_path, opened):
    changed = (f'value="bnVsbA==" encoded="yes" {PROXY}', PROXY)
    again = opened(rewritten(doc, tmp_path / "bad.FCStd", changed))
    obj = again.getObject(infill.Name)
    obj.StrutRadius = 0.8
    again.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert obj.StrutRadii == pytest.approx([0.8, 0.8])


def test_nobody_elses_object_is_touched(doc):
    other = doc.addObject("Mesh::FeaturePython", "Other")
    other.addProperty("App::PropertyString", "Fingerprint")
    other.addProperty("App::PropertyString", "Status")
    doc.recompute()
    assert revive(doc) == []
    assert other.Proxy is None


def test_results_of_a_wrong_type_are_made_anew_before_the_mesh(doc, infill, tmp_path, opened):
    """A file says that Volume and Status are other things than ours."""
    path = tmp_path / "part.FCStd"
    for name in ("Volume", "Mass"):
        infill.removeProperty(name)
        infill.addProperty("App::PropertyVector", name)
    doc.saveCopy(str(path))
    obj = opened(path).getObject(infill.Name)
    assert obj.Status == SPOILED
    obj.Document.recompute()
    assert obj.isValid(), obj.getStatusString()
    assert obj.Status == UP_TO_DATE
    assert obj.Volume.Value == pytest.approx(obj.Mesh.Volume, rel=1e-4)
    obj.StrutRadius = 0.8
    obj.Document.recompute()
    assert obj.Volume.Value == pytest.approx(obj.Mesh.Volume, rel=1e-4)


def test_a_result_that_was_spoiled_while_open_does_not_stop_it(doc, infill):
    for name in ("Status", "Volume"):
        infill.removeProperty(name)
    infill.addProperty("App::PropertyInteger", "Status")
    infill.StrutRadius = 0.8
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    assert infill.Status == UP_TO_DATE
    assert infill.Volume.Value == pytest.approx(infill.Mesh.Volume, rel=1e-4)


@pytest.mark.parametrize("name", ["StrutRadius", "CellType", "MapAround"])
def test_an_input_of_a_wrong_type_is_one_sentence(doc, infill, tmp_path, opened, name):
    before = infill.Mesh.CountFacets
    kind = infill.getTypeIdOfProperty(name)
    infill.removeProperty(name)
    infill.addProperty("App::PropertyString", name, "Lattice")
    setattr(infill, name, "one millimetre")
    path = tmp_path / "part.FCStd"
    doc.saveCopy(str(path))
    doc.recompute()
    obj = opened(path).getObject(infill.Name)
    for spoiled in (infill, obj):
        sentence = spoiled.Status
        assert sentence.startswith(f"The property {name} is of the type App::PropertyString")
        assert kind in sentence
        assert "defect" not in sentence
        assert getattr(spoiled, name) == "one millimetre", "nothing is lost"
        assert spoiled.Mesh.CountFacets == before
    assert not infill.isValid()
    obj.removeProperty(name)
    obj.touch()
    obj.Document.recompute()
    assert obj.isValid(), obj.getStatusString()


def test_an_object_of_a_later_version_keeps_its_mesh_and_its_number(doc, infill, tmp_path, opened):
    before = infill.Mesh.CountFacets
    infill.SchemaVersion = SCHEMA_VERSION + 2
    path = tmp_path / "part.FCStd"
    doc.saveCopy(str(path))
    obj = opened(path).getObject(infill.Name)
    assert "later version of VOLFREP" in obj.Status
    assert obj.SchemaVersion == SCHEMA_VERSION + 2
    obj.StrutRadius = 0.8
    obj.Document.recompute()
    assert not obj.isValid()
    assert obj.getStatusString() == obj.Status
    assert "later version of VOLFREP" in obj.Status
    assert obj.Mesh.CountFacets == before
    assert obj.SchemaVersion == SCHEMA_VERSION + 2


@pytest.mark.parametrize("package", ["freecad_volfrep", "freecad.volfrep"])
def test_documents_open_whichever_way_the_workbench_was_installed(
    doc, infill, tmp_path, opened, package
):
    other = PROXY.replace("freecad.volfrep", package)
    again = opened(rewritten(doc, tmp_path / "other.FCStd", (PROXY, other)))
    obj = again.getObject(infill.Name)
    assert isinstance(obj.Proxy, LatticeInfill)
    assert obj.Status == UP_TO_DATE
