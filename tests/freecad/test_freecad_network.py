# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks in place of cells, by the properties of the document's object."""

import json

import FreeCAD as App
import Part
import pytest

from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.export.solver_files import write_solver_file
from freecad_volfrep.features.infill.live_preview import LivePreview


@pytest.fixture
def box(doc):
    solid = doc.addObject("Part::Box", "Solid")
    solid.Length = solid.Width = solid.Height = 24
    doc.recompute()
    return solid


@pytest.mark.costly
def test_a_voronoi_network_fills_a_solid_and_follows_its_seed(doc, box):
    obj = make_lattice_infill(
        doc, box, Network="Voronoi", NetworkPoints=15, StrutRadius=0.6, ShellThickness=1.5
    )
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert obj.Mesh.isSolid()
    assert obj.Bodies == 1
    assert obj.Struts > 20
    before = obj.Volume.Value
    obj.NetworkSeed = 2
    doc.recompute()
    assert obj.Volume.Value != before
    assert json.loads(obj.Report)["spec"]["network"]["seed"] == 2


def test_a_network_is_written_as_beams_and_turned(doc, box, tmp_path):
    nodes = [[0, 0, 0], [24, 24, 24], [24, 0, 0], [0, 24, 24], [12, 12, 12]]
    file = tmp_path / "net.json"
    file.write_text(json.dumps({"nodes": nodes, "struts": [[k, 4] for k in range(4)]}))
    obj = make_lattice_infill(
        doc, box, Network="File", NetworkFile=str(file), StrutRadius=1, ShellThickness=1.5
    )
    doc.recompute()
    deck = tmp_path / "net.inp"
    write_solver_file(obj, deck, "beam deck")
    assert "*BEAM SECTION" in deck.read_text()
    before = obj.Volume.Value
    turn = App.Rotation(App.Vector(0, 0, 1), 45)
    obj.Orientation = App.Placement(App.Vector(), turn)
    doc.recompute()
    assert obj.isValid(), obj.Status
    # Struts to the corners end at faces now, and are shorter.
    assert obj.Volume.Value < before - 1.0


@pytest.mark.slow
def test_a_network_is_shown_before_it_is_made_and_meets_a_density(doc, box):
    obj = make_lattice_infill(
        doc, box, Network="Voronoi", NetworkPoints=15, ShellThickness=1.5,
        RadiusDrivenBy="Relative density", TargetDensity=0.12, NetworkOnWall=True,
    )  # fmt: skip
    shown = LivePreview(obj).show()
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert obj.RelativeDensity == pytest.approx(0.12, rel=5e-3)
    assert shown.preview.spec.strut_radius == pytest.approx(obj.StrutRadius.Value, rel=0.05)
    assert 0.7 * obj.Struts < shown.preview.struts <= obj.Struts  # those that reach inside


@pytest.mark.slow
def test_a_cells_values_are_a_property(doc, box):
    obj = make_lattice_infill(
        doc, box, CellType="Re-entrant", CellSize=12, ShellThickness=1.5, CellValues="arm = 0.2"
    )
    doc.recompute()
    assert obj.isValid(), obj.Status
    before = obj.Volume.Value
    obj.CellValues = ""
    doc.recompute()
    assert obj.Volume.Value != before
    obj.CellValues = "leg = 0.2"
    doc.recompute()
    assert "has no value 'leg'" in obj.Status


def test_a_network_of_a_file(doc, box, tmp_path):
    nodes = [[0, 0, 0], [24, 24, 24], [24, 0, 0], [0, 24, 24], [12, 12, 12]]
    file = tmp_path / "net.json"
    file.write_text(json.dumps({"nodes": nodes, "struts": [[k, 4] for k in range(4)]}))
    obj = make_lattice_infill(doc, box, Network="File", StrutRadius=1, ShellThickness=1.5)
    doc.recompute()
    assert not obj.isValid()
    assert "needs NetworkFile" in obj.Status
    obj.NetworkFile = str(file)
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert (obj.Nodes, obj.Struts, obj.Bodies) == (5, 4, 1)
    assert App.ActiveDocument is not None


def test_a_network_follows_its_file(doc, box, tmp_path):
    file = tmp_path / "net.json"
    nodes = [[0, 0, 0], [24, 24, 24], [24, 0, 0], [0, 24, 24], [12, 12, 12]]
    struts = [[k, 4] for k in range(4)]
    file.write_text(json.dumps({"nodes": nodes, "struts": struts}))
    obj = make_lattice_infill(
        doc, box, Network="File", NetworkFile=str(file), StrutRadius=1, ShellThickness=1.5
    )
    doc.recompute()
    before = obj.Volume.Value
    nodes[4] = [12, 12, 17]  # as many nodes and struts as before
    file.write_text(json.dumps({"nodes": nodes, "struts": struts}))
    obj.touch()
    doc.recompute()
    assert obj.Volume.Value != before


@pytest.fixture
def sector(doc):
    """A quarter of a tube, its inner and outer faces."""
    tube = doc.addObject("Part::Feature", "Sector")
    outer = Part.makeCylinder(30, 40, App.Vector(), App.Vector(0, 0, 1), 90)
    tube.Shape = outer.cut(Part.makeCylinder(20, 40, App.Vector(), App.Vector(0, 0, 1), 90))
    doc.recompute()
    curved = [k for k, face in enumerate(tube.Shape.Faces) if type(face.Surface) is Part.Cylinder]
    by_area = sorted(curved, key=lambda k: tube.Shape.Faces[k].Area)
    return tube, [f"Face{k + 1}" for k in by_area]


def radii_of(obj):
    """Of the nodes of the network, from the tube's axis."""
    from freecad_volfrep.features.infill.values import specification_of

    nodes = specification_of(obj).network.nodes
    return (nodes[:, 0] ** 2 + nodes[:, 1] ** 2) ** 0.5


@pytest.mark.slow
def test_cells_lie_between_the_two_faces_of_a_tubes_sector(doc, sector):
    tube, (inner, outer) = sector
    obj = make_lattice_infill(
        doc, tube, CellType="Octet", Network="Faces", CellSize=8, StrutRadius=0.7, ShellThickness=0
    )
    doc.recompute()
    assert "NetworkFaces" in obj.Status
    obj.NetworkFaces = [(tube, (inner, outer))]
    obj.NetworkLayers = 1
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert obj.Mesh.isSolid()
    assert obj.Bodies == 1
    radii = radii_of(obj)
    assert radii.min() == pytest.approx(20, abs=1e-9)
    assert radii.max() == pytest.approx(30, abs=1e-9)
    # 5 cells along the height; 39.3 mm of arc in the mean are 5 too. Octet has a node in the
    # middle of every face: on the curved faces, not on their chords.
    assert sum(abs(radii - 30) < 1e-9) == 6 * 6 + 5 * 5
    tube.Shape = tube.Shape.transformGeometry(App.Matrix(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.5, 0))
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert obj.Mesh.BoundBox.ZLength > 55


def test_layers_grow_from_one_face_into_the_solid(doc, sector):
    tube, (_, outer) = sector
    obj = make_lattice_infill(
        doc, tube, CellType="BCC", Network="Faces", CellSize=8, StrutRadius=0.7, ShellThickness=0
    )
    obj.NetworkFaces = [(tube, (outer,))]
    doc.recompute()
    assert "NetworkThickness" in obj.Status
    obj.NetworkThickness, obj.NetworkLayers = 8, 2
    doc.recompute()
    assert obj.isValid(), obj.Status
    radii = radii_of(obj)
    assert (radii.min(), radii.max()) == (pytest.approx(22), pytest.approx(30))


@pytest.fixture
def wing(doc):
    """A NACA 0012 between its spars, of chord 200: its upper and its lower skin are splines."""

    def half(x):
        return 0.6 * (0.2969 * x**0.5 - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1015 * x**4)

    shares = [0.05 + 0.6 * (k / 40) ** 1.5 for k in range(41)]
    sides = []
    for sign in (1, -1):
        curve = Part.BSplineCurve()
        curve.interpolate([App.Vector(200 * x, 0, sign * 200 * half(x)) for x in shares])
        sides.append(curve.toShape())
    upper, lower = sides
    ends = [
        Part.makeLine(upper.valueAt(at), lower.valueAt(at))
        for at in (upper.FirstParameter, upper.LastParameter)
    ]
    flat = Part.Face(Part.Wire([upper, ends[1], lower, ends[0]]))
    made = doc.addObject("Part::Feature", "Wing")
    made.Shape = flat.extrude(App.Vector(0, 60, 0))
    doc.recompute()
    skins = [
        k
        for k, face in enumerate(made.Shape.Faces)
        if abs(face.BoundBox.XLength - 120) < 1 and face.BoundBox.YLength > 59
    ]
    skins.sort(key=lambda k: -made.Shape.Faces[k].CenterOfMass.z)
    return made, [f"Face{k + 1}" for k in skins]


def ends_from(obj, face):
    """How far each node of the lattice that is made lies from a face, by FreeCAD, mm."""
    from freecad_volfrep.bridge.solids import mesh_of_shape
    from freecad_volfrep.features.infill.values import specification_of
    from volfrep.jobs.infill import Infill

    struts = Infill(mesh_of_shape(obj.Base.Shape, "wing"), specification_of(obj)).struts
    return [Part.Vertex(*node).distToShape(face)[0] for node in struts.nodes.tolist()]


@pytest.mark.costly
def test_the_ends_of_struts_lie_on_a_wings_skins(doc, wing):
    made, names = wing
    obj = make_lattice_infill(
        doc, made, CellType="BCC", Network="Faces", CellSize=12, StrutRadius=0.8, ShellThickness=0
    )
    deviation, on_face = 0.8 / 35, 11 * 6
    skins = [made.getSubObject(name) for name in names]
    obj.NetworkFaces, obj.NetworkLayers = [(made, tuple(names))], 1
    for skin in skins:
        away = sorted(ends_from(obj, skin))
        assert away[on_face - 1] < 0.2 * deviation < away[on_face]
    obj.NetworkFaces, obj.NetworkThickness = [(made, (names[0],))], 6
    away = sorted(ends_from(obj, skins[0]))
    assert away[on_face - 1] < 0.2 * deviation
    assert all(abs(far - 6) < 0.2 * deviation for far in away[-on_face:])


@pytest.mark.costly
def test_a_face_that_is_no_rectangle_serves_and_one_of_three_sides_does_not(doc):
    corners = [(0, 0, 0), (30, 4, 0), (26, 22, 0), (-3, 17, 0), (0, 0, 0)]
    base = doc.addObject("Part::Feature", "Prism")
    flat = Part.Face(Part.makePolygon([App.Vector(*c) for c in corners]))
    base.Shape = flat.extrude(App.Vector(0, 0, 12))
    wedge = doc.addObject("Part::Feature", "Wedge")
    flat = Part.Face(Part.makePolygon([App.Vector(*c) for c in (*corners[:3], corners[0])]))
    wedge.Shape = flat.extrude(App.Vector(0, 0, 12))
    doc.recompute()

    def ends(solid):
        return [
            f"Face{k + 1}"
            for k, face in enumerate(solid.Shape.Faces)
            if abs(face.normalAt(0, 0).z) > 0.9
        ]

    obj = make_lattice_infill(
        doc, base, CellType="Box", Network="Faces", CellSize=6, StrutRadius=0.5, ShellThickness=0
    )
    obj.NetworkFaces = [(base, tuple(ends(base)))]
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert obj.Bodies == 1
    other = make_lattice_infill(doc, wedge, Network="Faces", CellSize=6, StrutRadius=0.5)
    other.NetworkFaces = [(wedge, tuple(ends(wedge)))]
    doc.recompute()
    assert not other.isValid()
    assert "has 3 sides" in other.Status
