# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tables of Check Mesh and Statistics, as windows show and files hold them."""

import csv
import io
import re
from xml.etree import ElementTree

import FreeCAD as App
import Mesh
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.properties.quantities import mass_of, set_value
from freecad_volfrep.features.reports.mesh_check import check_mesh
from freecad_volfrep.features.reports.statistics import infills_of, statistics
from freecad_volfrep.translation import TRANSLATIONS
from volfrep.reports.tables import Table, as_csv, as_html
from volfrep.util.errors import VolfrepError


def rows_of(tables):
    return {row[0]: row[1] for table in tables for row in table.rows}


def mesh_object(doc, mesh):
    obj = doc.addObject("Mesh::Feature", "Surface")
    obj.Mesh = mesh
    return obj


def test_a_lattice_is_without_defects(infill):
    tables = check_mesh(infill)
    rows = rows_of(tables)
    assert tables[0].title == f"{infill.Label}: closed and without defects"
    assert rows["triangles"] == f"{infill.Triangles:,}"
    assert rows["genus"] == str(infill.Genus)
    assert rows["voids"] == str(infill.Voids)
    assert rows["along lines through it"] == "every place inside is enclosed once"
    assert rows["triangles that cross"] == "none"
    assert rows["a solid"] == "yes"


def test_every_name_in_the_tables_has_its_translation(infill):
    tables = [*check_mesh(infill)[1:], *statistics([infill])]
    names = {row[0] for table in [check_mesh(infill)[0], *tables] for row in table.rows}
    names |= {table.title for table in tables}
    for path in TRANSLATIONS.glob("*.ts"):
        known = {message.findtext("source") for message in ElementTree.parse(path).iter("message")}
        assert names - known == set(), path.name


def test_statistics_tell_what_the_lattice_does(doc, infill):
    does = {table.title: table for table in statistics([infill])}["What the lattice does"]
    rows = {row[0]: row[1] for row in does.rows}
    assert {"relative density", "E along [111]", "shear modulus", "strength"} <= rows.keys()
    assert re.fullmatch(r"[\d.e-]+ \+- [\d.e-]+ E of the solid", rows["E along [100]"])
    infill.PrintMaterial = "AlSi10Mg"
    doc.recompute()
    does = {table.title: table for table in statistics([infill])}["What the lattice does"]
    assert {row[0]: row[1] for row in does.rows}["E along [100]"].endswith(" MPa")
    infill.AutoUpdate = False
    infill.StrutRadius = 0.8
    doc.recompute()  # the mesh does not fit the properties any more
    does = {table.title: table for table in statistics([infill])}["What the lattice does"]
    assert does.rows == ()


@pytest.mark.slow
def test_statistics_tell_what_walls_do(doc, infill, monkeypatch):
    """On coarse grids: how fine they are is the engine's matter."""
    asked = []

    def coarse(title, job, *arguments, has_progress, **keywords):
        asked.append(keywords)
        return job(*arguments, **keywords, along=16)

    monkeypatch.setattr("freecad_volfrep.features.reports.statistics.run_job", coarse)
    infill.CellType = "Gyroid"
    infill.WallThickness = 1.5
    doc.recompute()
    does = {table.title: table for table in statistics([infill])}["What the lattice does"]
    rows = {row[0]: row[1] for row in does.rows}
    assert len(asked) == 1
    assert {"relative density", "E along [100]", "shear modulus", "strength"} <= rows.keys()


def test_a_window_may_say_tables_in_other_words():
    table = Table("Sizes", (("cell", 3, True),), ("", "A", "B"))
    said = {"Sizes": "Größen", "cell": "Zelle", "yes": "ja"}
    text = as_html([table], lambda word: said.get(word, word))
    assert all(word in text for word in ("Größen", "Zelle", "ja", "3"))


def test_tables_of_long_lines_fit_the_window():
    short, long = ("cell", 3), ("most stressed strut, at x, y, z", "5.002, 10, 0.0017", "at one")
    assert as_html([Table("Sizes", (short,))]).count('width="99%"') == 0
    assert as_html([Table("Sizes", (short,)), Table("Loads", (short, long))]).count("99%") == 1


def test_any_mesh_is_checked_where_it_lies(doc):
    obj = mesh_object(doc, Mesh.createBox(10, 10, 10))
    obj.Placement.Base = App.Vector(100, 0, 0)
    rows = rows_of(check_mesh(obj))
    assert rows["volume"] == "1,000.000 mm3"
    assert rows["from"] == "95.000, -5.000, -5.000"


def test_an_open_mesh_is_called_so(doc):
    mesh = Mesh.createBox(10, 10, 10)
    mesh.removeFacets([0])
    tables = check_mesh(mesh_object(doc, mesh))
    assert tables[0].title.endswith("not closed")
    assert rows_of(tables)["closed"] == "no (3 open edges)"
    assert rows_of(tables)["a solid"] == "no"


def test_crossing_surfaces_are_found_where_they_are(doc):
    mesh, other = Mesh.createBox(10, 10, 10), Mesh.createBox(10, 10, 10)
    other.translate(3, 3, 3)
    mesh.addMesh(other)
    obj = mesh_object(doc, mesh)

    def crossing():
        rows = rows_of(check_mesh(obj))
        assert "enclosed more than once" in rows["along lines through it"]
        place = re.search(r"first near \((.*)\)", rows["triangles that cross"])
        return [float(number) for number in place[1].split(",")]

    # The boxes are (-5, 5) and (-2, 8): their faces cross in what they have in common.
    here = crossing()
    assert all(-2.0 <= number <= 5.0 for number in here)
    obj.Placement.Base = App.Vector(100, 0, 0)
    there = crossing()
    assert there == pytest.approx([here[0] + 100.0, here[1], here[2]])


def test_crossing_triangles_that_enclose_nothing_twice_are_a_defect(doc):
    """Of an open sheet through another no line can tell: only its triangles do."""
    sheet = Mesh.Mesh([[(-5, -5, 0), (5, -5, 0), (0, 5, 0)], [(0, 0, -5), (1, 0, 5), (0, 1, 5)]])
    rows = rows_of(check_mesh(mesh_object(doc, sheet)))
    assert rows["triangles that cross"].startswith("1 pair, first near (0")


def test_nothing_to_check_is_one_sentence(doc, box):
    obj = make_lattice_infill(doc, box, **SMALL)
    with pytest.raises(VolfrepError, match="has no mesh to check"):
        check_mesh(obj)


def test_statistics_stand_beside_each_other(doc, box, infill):
    waiting = make_lattice_infill(doc, box, **SMALL, Label="Waiting")
    assert infills_of(doc) == [infill, waiting]
    inputs, result, does, seconds, memory = statistics([infill, waiting])
    assert all(row[1] and row[2] is None for row in does.rows)
    assert inputs.header == ("", infill.Label, "Waiting")
    rows = {row[0]: row[1:] for table in (inputs, result) for row in table.rows}
    assert rows["cell size, mm"] == (10.0, 10.0)
    assert rows["struts"] == (infill.Struts, None)
    assert rows["joints"] == (infill.Nodes, None)
    assert rows["relative density, %"] == (pytest.approx(100 * infill.RelativeDensity), None)
    assert rows["mass, g"] == (mass_of(infill), None)
    assert rows["status"] == ("Up to date", "Not computed yet")
    assert seconds.rows[-1][1] == pytest.approx(infill.Seconds)
    assert seconds.rows[-1][2] is None
    assert memory.rows[-1][1] == max(row[1] for row in memory.rows)


def test_the_mass_is_that_of_the_present_density(doc, infill):
    set_value(infill, "Density", 2.7)
    doc.recompute()
    rows = {row[0]: row[1] for row in statistics([infill])[1].rows}
    assert rows["mass, g"] == pytest.approx(2.7 * rows["volume, mm3"] / 1000)


def test_no_infill_is_one_sentence():
    with pytest.raises(VolfrepError, match="There is no lattice infill"):
        statistics([])


def test_tables_as_files():
    tables = [
        Table("One & two", (("a, b", 1234567, 0.5), ("c", None, True)), ("", "<x>", "y")),
        Table("Three", (("d", "e"),)),
    ]
    read = list(csv.reader(io.StringIO(as_csv(tables))))
    assert read == [
        ["One & two"],
        ["", "<x>", "y"],
        ["a, b", "1234567", "0.5"],
        ["c", "", "True"],
        [],
        ["Three"],
        ["d", "e"],
    ]
    html = as_html(tables)
    for text in ("One &amp; two", "&lt;x&gt;", "1,234,567", "<td>-</td>", "<td>yes</td>"):
        assert text in html
