# SPDX-License-Identifier: LGPL-2.1-or-later
"""Formats: what each may hold, units, and what is refused."""

import io
import re
import shutil
import struct
import zipfile

import numpy as np
import pytest
import trimesh

import samples
from volfrep.cli import command as cli
from volfrep.io.read.units import refuse_scale
from volfrep.io.solid import read_solid, read_triangles
from volfrep.io.write.step_faceted import write_step_faceted
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.output.meshes import write_mesh
from volfrep.util.errors import VolfrepError

needs_freecad = pytest.mark.skipif(
    shutil.which("freecadcmd") is None, reason="freecadcmd, which reads CAD files, is not there"
)


def written(tmp_path, name, content):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def refused(path, words):
    with pytest.raises(VolfrepError, match=words) as error:
        read_solid(path)
    assert path.name in str(error.value)


# --- STL ----------------------------------------------------------------------------------------


def ascii_stl(mesh, name="part"):
    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*map(float, p)) for p in corners)
        + "endloop\nendfacet\n"
        for corners in mesh.vertices[mesh.triangles]
    )
    return f"solid {name}\n{facets}endsolid {name}\n"


@pytest.mark.parametrize(
    "dress",
    [
        str.upper,
        lambda text: text.replace("\n", "\r\n"),
        lambda text: text.replace("\n", "\r"),
        lambda text: "\ufeff" + text,
        lambda text: text.replace("solid part", "solid facet normal vertex of 3 endsolid"),
        lambda text: text + "\n\n",
    ],
)
def test_ascii_stl_in_any_dress(tmp_path, dress):
    path = written(tmp_path, "part.stl", dress(ascii_stl(samples.box())))
    assert read_solid(path).volume == pytest.approx(24_000.0)


def test_all_solids_of_an_ascii_stl_are_read(tmp_path):
    two = ascii_stl(samples.box(), "one") + ascii_stl(samples.box((1,) * 3, (50, 0, 0)), "two")
    assert read_solid(written(tmp_path, "two.stl", two)).volume == pytest.approx(24_001.0)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("outer loop", "loop", "facet 1 has 'loop' where 'outer' belongs"),
        ("endfacet\nendsolid", "endsolid", "facet 12 is not complete"),
        ("vertex 0.0", "vertex 0.0 0.0", "facet 1 has .* where 'vertex' belongs"),
        ("0.0 0.0 0.0", "0.0 0.0 O.0", "'o.0' is not a number"),
        ("0.0 0.0 0.0", f"0.0 0.0 {'1' * 5000}", "a word of 5000 letters"),
        ("endsolid part", "", "cut short"),
    ],
)
def test_damaged_ascii_stl_is_refused_with_its_facet(tmp_path, old, new, words):
    text = ascii_stl(samples.box())
    assert old in text
    refused(written(tmp_path, "part.stl", text.replace(old, new, 1)), words)


# --- OBJ and PLY --------------------------------------------------------------------------------

#: A box of 2 x 3 x 4 with an L-shaped end, so that two faces are concave.
L_CORNERS = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 3), (0, 3)]
L_VOLUME = 4.0 * 4.0


def l_shape():
    """Vertices and polygons, from 0."""
    points = [(x, y, z) for z in (0, 4) for x, y in L_CORNERS]
    sides = [(k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6) for k in range(6)]
    return points, [tuple(range(5, -1, -1)), tuple(range(6, 12)), *sides]


@pytest.mark.parametrize(
    "face",
    [
        lambda k: f"{k + 1}",
        lambda k: f"{k - 12}",
        lambda k: f"{k + 1}/7/9",
        lambda k: f"{k + 1}//3",
    ],
)
def test_obj_polygons_however_they_name_their_vertices(tmp_path, face):
    points, faces = l_shape()
    lines = [
        "# unit: cm",
        "mtllib x.mtl",
        "o part",
        *("v {} {} {} 0.5 1 1".format(*p) for p in points),
    ]
    lines += ["vn 0 0 1", "vt 0 0", "s off", *(" f " + " \\\n ".join(map(face, f)) for f in faces)]
    solid = read_solid(written(tmp_path, "part.obj", "\r\n".join(lines)))
    assert solid.volume == pytest.approx(1000.0 * L_VOLUME)
    assert solid.repairs == ()
    assert solid.states_unit


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "names vertex 4, and there are 3"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "names vertex 0"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "fewer than three corners"),
        ("v 0 0\nf 1 1 1\n", "fewer than three coordinates"),
        ("v 0 0 zero\nf 1 1 1\n", "'zero' is not a number"),
        ("v 0 0 0\nf 1 1 1.5\n", "no whole number"),
        (f"v 0 0 0\nf 1 1 {'9' * 30}\n", "no whole number"),
        ("v 0 0 0\nl 1 1\n", "no.* OBJ file with faces"),
        ("v 0 0 0\0\nf 1 1 1\n", "no text"),
    ],
)
def test_damaged_obj_is_refused(tmp_path, text, words):
    refused(written(tmp_path, "part.obj", text), words)


def ply(order, polygons=True):
    points, faces = l_shape()
    if not polygons:
        faces = [(f[0], f[k], f[k + 1]) for f in faces[2:] for k in range(1, len(f) - 1)]
    header = (
        f"ply\nformat {order} 1.0\ncomment unit: cm\nelement vertex 12\nproperty double x\n"
        "property float y\nproperty float z\nproperty uchar red\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
        "property list uchar float texcoord\nproperty uchar flag\nend_header\n"
    )
    if order == "ascii":
        rows = ["{} {} {} 9".format(*p) for p in points]
        rows += [f"{len(f)} {' '.join(map(str, f))} 2 0.5 0.5 1" for f in faces]
        return header.encode() + "\n".join(rows).encode()
    e = ">" if "big" in order else "<"
    body = b"".join(struct.pack(e + "dffB", *p, 9) for p in points)
    for f in faces:
        body += struct.pack(f"{e}B{len(f)}iBffB", len(f), *f, 2, 0.5, 0.5, 1)
    return header.encode() + body


@pytest.mark.parametrize("order", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_ply_of_any_order_with_mixed_polygons(tmp_path, order):
    solid = read_solid(written(tmp_path, "part.ply", ply(order)))
    assert solid.volume == pytest.approx(1000.0 * L_VOLUME)
    assert solid.repairs == ()


@pytest.mark.parametrize("order", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_ply_cut_short_is_refused(tmp_path, order):
    data = ply(order)
    refused(written(tmp_path, "part.ply", data[:-20]), "cut short|damaged")
    refused(written(tmp_path, "part.ply", data[:90]), "header is missing")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (b"element vertex 12", b"element vertex 4000000000", "cut short|damaged"),
        (b"element face 8", b"element face 99999999999999", "cut short"),
        (b"element face 8", b"element face x", "its header has the line"),
        (b"vertex_indices", b"something_else", "no list 'vertex_indices'"),
        (b"property float z", b"property float q", "no x, y and z"),
        (b"property float z", b"property float x", "named twice"),
        (b"format ascii", b"format martian", "its header has the line"),
        (b"\n6 5 4", b"\n6 5 77", "names a vertex that is not among the 12"),
        (b"\n6 5 4", b"\n6000 5 4", "a list in 'face' promises 6000 values"),
        (b"\n6 5 4", b"\n6 5 4.5", "whole numbers"),
        (b"\n6 5 4", b"\n6 5 four", "'four' is not a number"),
    ],
)
def test_damaged_ply_is_refused(tmp_path, old, new, words):
    data = ply("ascii")
    assert old in data
    refused(written(tmp_path, "part.ply", data.replace(old, new)), words)


# --- 3MF ----------------------------------------------------------------------------------------

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
RELATIONS = (
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    '<Relationship Id="r" Target="/3D/3dmodel.model" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
)


def mesh_xml(mesh, prefix=""):
    p = prefix
    vertices = "".join(
        '<{}vertex z="{}" y="{}" x="{}"/>'.format(p, *map(float, v[::-1])) for v in mesh.vertices
    )
    triangles = "".join(
        '<{}triangle v1="{}" v2="{}" v3="{}" pid="7" p1="0"/>'.format(p, *t) for t in mesh.triangles
    )
    return (
        f"<{p}mesh><{p}vertices>{vertices}</{p}vertices>"
        f"<{p}triangles>{triangles}</{p}triangles></{p}mesh>"
    )


def model_xml(resources, build, unit="", more=""):
    return (
        f'<?xml version="1.0"?>{more}<model {unit} xmlns="{CORE}" xmlns:c="{CORE}" xmlns:p="x">'
        f"<resources>{resources}</resources><build>{build}</build></model>"
    )


def package(model, **parts):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("_rels/.rels", RELATIONS)
        archive.writestr("3D/3dmodel.model", model)
        for name, text in parts.items():
            archive.writestr(f"3D/{name}.model", text)
    return file.getvalue()


def object_xml(number, inside, more=""):
    return f'<object id="{number}" {more}>{inside}</object>'


BOX = object_xml(1, mesh_xml(samples.box()))
ITEM = '<item objectid="1"/>'


def test_3mf_that_volfrep_writes_comes_back(tmp_path):
    part = samples.plate(48)
    write_mesh(part, tmp_path / "part.3mf")
    solid = read_solid(tmp_path / "part.3mf")
    # Coordinates are written in single precision: 6e-8 of 60 mm.
    assert solid.volume == pytest.approx(part.volume, rel=1e-6)
    assert solid.states_unit
    assert solid.repairs == ()


def test_3mf_in_inches_with_places_and_assemblies(tmp_path):
    """The box twice in an assembly, once mirrored, and the assembly built in two places."""
    twice = (
        "<components><component objectid='1'/>"
        "<component objectid='1' transform='-1 0 0 0 1 0 0 0 1 -10 0 0'/></components>"
    )
    model = model_xml(
        "<!-- <vertices> -->" + BOX + object_xml(2, twice),
        '<item objectid="2"/><item objectid="2" transform="0 1 0 -1 0 0 0 0 2 0 0 100"/>',
        'unit="inch"',
    )
    solid = read_solid(written(tmp_path, "part.3mf", package(model)))
    assert solid.volume == pytest.approx(24_000.0 * (2 + 2 * 2) * 25.4**3)
    assert solid.repairs == ()
    low, high = solid.bounds / 25.4
    assert low == pytest.approx([-50.0, -50.0, 0.0])
    assert high == pytest.approx([40.0, 40.0, 140.0])


def test_3mf_with_prefixes_and_parts_in_other_files(tmp_path):
    far = model_xml(BOX, "").replace("<object", "<c:object").replace("</object", "</c:object")
    far = far.replace(mesh_xml(samples.box()), mesh_xml(samples.box(), "c:"))
    near = object_xml(
        5, '<components><component objectid="1" p:path="/3D/far.model"/></components>'
    )
    model = model_xml(near, '<item objectid="5"/>')
    path = written(tmp_path, "part.3mf", package(model, far=far))
    assert read_solid(path).volume == pytest.approx(24_000.0)


def test_3mf_supports_are_left_out(tmp_path):
    model = model_xml(
        BOX + object_xml(2, mesh_xml(samples.sphere(50.0)), 'type="support"'),
        ITEM + '<item objectid="2"/>',
    )
    solid = read_solid(written(tmp_path, "part.3mf", package(model)))
    assert solid.volume == pytest.approx(24_000.0)
    assert "left out" in solid.warnings[0]


DEEP = "".join(
    object_xml(k + 1, f'<components><component objectid="{k}"/></components>') for k in range(1, 60)
)
WIDE = "".join(
    object_xml(k + 1, "<components>" + f'<component objectid="{k}"/>' * 2 + "</components>")
    for k in range(1, 30)
)


BEAMS = "<beamlattice/>"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"PK\x03\x04 no zip", "no zip file"),
        (package(model_xml(BOX, ITEM))[:-100], "no zip file"),
        (package(model_xml(BOX, "")), "builds no object"),
        (package(model_xml(BOX, '<item objectid="9"/>')), "object '9' is missing"),
        (package(model_xml(BOX, ITEM, 'unit="parsec"')), "unit 'parsec'"),
        (package(model_xml(BOX, ITEM)[:-20]), "no valid XML"),
        (
            package(model_xml(BOX.replace("</vertices>", ""), ITEM)),
            "ends inside a list|no valid XML",
        ),
        (package(model_xml(BOX.replace('x="0.0"', 'q="0.0"', 1), ITEM)), "lacks one of x, y, z"),
        (package(model_xml(BOX.replace('x="0.0"', 'x="no"', 1), ITEM)), "'no' is not a number"),
        (package(model_xml(BOX.replace('v1="', 'v1="9', 1), ITEM)), "vertex that is not there"),
        (package(model_xml(BOX, '<item objectid="1" transform="1 2"/>')), "twelve numbers"),
        (package(model_xml(BOX + DEEP, '<item objectid="60"/>')), "too many parts"),
        (package(model_xml(BOX + WIDE, '<item objectid="30"/>')), "too many parts"),
        (
            package(model_xml(BOX, ITEM, more='<!DOCTYPE m [<!ENTITY a "b">]>')),
            "document type",
        ),
        (package(model_xml(BOX + " " * 30_000_000, ITEM)), "unpacks to more than"),
        (
            package(model_xml(re.sub(r"<triangles>.*</triangles>", BEAMS, BOX, flags=re.S), ITEM)),
            "lattice of beams",
        ),
    ],
)
def test_damaged_or_hostile_3mf_is_refused(tmp_path, data, words):
    refused(written(tmp_path, "part.3mf", data), words)


def test_the_triangles_of_a_file_of_both_are_read(tmp_path):
    data = package(model_xml(BOX.replace("</mesh>", BEAMS + "</mesh>"), ITEM))
    solid = read_solid(written(tmp_path, "both.3mf", data))
    assert solid.volume == pytest.approx(read_solid(written(tmp_path, "box.3mf", package(
        model_xml(BOX, ITEM)
    ))).volume)  # fmt: skip
    assert any("beams beside its triangles" in note for note in solid.notes)


def test_an_assembly_that_holds_itself_is_refused(tmp_path):
    loop = object_xml(1, '<components><component objectid="1"/></components>')
    refused(written(tmp_path, "part.3mf", package(model_xml(loop, ITEM))), "too many parts")


def test_3mf_text_in_utf_16_is_read(tmp_path):
    model = model_xml(BOX, ITEM).encode("utf-16")
    path = written(tmp_path, "part.3mf", package(model))
    assert read_solid(path).volume == pytest.approx(24_000.0)


# --- CAD ----------------------------------------------------------------------------------------


@needs_freecad
def test_step_is_read_by_freecad(tmp_path):
    part = samples.box()
    write_mesh(part, tmp_path / "box.step")
    solid = read_solid(tmp_path / "box.step")
    assert solid.volume == pytest.approx(24_000.0)
    assert solid.states_unit
    refused(written(tmp_path, "no.brep", b"DBRep_DrawableShape\nnonsense"), "FreeCAD")


@pytest.mark.costly
@needs_freecad
def test_solids_of_step_that_meet_are_united_and_told(tmp_path):
    boxes = [samples.box((10.0, 10.0, 10.0), (8.0 * k, 0.0, 0.0)) for k in range(3)]
    write_step_faceted(concatenate(*boxes), tmp_path / "three.step")
    solid = read_solid(tmp_path / "three.step")
    assert solid.volume == pytest.approx(2600.0)
    assert any("holds 3 solids that meet, which were united to one" in n for n in solid.notes)
    apart = [samples.box((10.0, 10.0, 10.0), (20.0 * k, 0.0, 0.0)) for k in range(2)]
    write_step_faceted(concatenate(*apart), tmp_path / "two.step")
    assert read_solid(tmp_path / "two.step").notes == ()


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("ISO-10303-21;", "ISO-9999;", "header is missing"),
        ("END-ISO-10303-21;", "", "cut short"),
        (
            "\nENDSEC;\nEND-ISO",
            "\n#77777=CARTESIAN_POINT('',(0.,#88888));\nENDSEC;\nEND-ISO",
            "#88888",
        ),
        (
            "\nENDSEC;\nEND-ISO",
            "\n77777=PLANE('');\nENDSEC;\nEND-ISO",
            "no statement where .*77777",
        ),
    ],
)
def test_damaged_step_is_refused_before_a_kernel_reads_it(tmp_path, old, new, words):
    write_mesh(samples.box(), tmp_path / "box.step")
    text = (tmp_path / "box.step").read_text()
    assert old in text
    refused(written(tmp_path, "part.step", text.replace(old, new)), words)


def test_an_instance_that_is_lost_or_doubled_in_step_is_refused(tmp_path):
    write_mesh(samples.box(), tmp_path / "box.step")
    lines = (tmp_path / "box.step").read_text().splitlines(keepends=True)
    at = next(k for k, line in enumerate(lines) if "CARTESIAN_POINT" in line)
    lost, doubled = lines[:at] + lines[at + 1 :], lines[:at] + lines[at : at + 1] + lines[at:]
    refused(written(tmp_path, "lost.step", "".join(lost)), "names an instance #")
    refused(written(tmp_path, "doubled.step", "".join(doubled)), "there twice")


def test_without_freecad_a_sentence_says_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    refused(written(tmp_path, "part.brep", b"DBRep"), "install FreeCAD, or convert")


# --- units --------------------------------------------------------------------------------------


def stl_with_header(header):
    data = trimesh.Trimesh(*_arrays(samples.box())).export(file_type="stl")
    return header.ljust(80) + data[80:]


def _arrays(mesh: TriangleMesh):
    return mesh.vertices, mesh.triangles


@pytest.mark.parametrize(
    ("header", "scale", "stated"),
    [
        (b"solid UNITS=mm", 1.0, True),
        (b"made somewhere, Units: inches", 25.4, True),
        (b"unit=parsec", 1.0, False),
        (b"plain", 1.0, False),
    ],
)
def test_stl_headers_that_name_a_unit(tmp_path, header, scale, stated):
    solid = read_solid(written(tmp_path, "part.stl", stl_with_header(header)))
    assert solid.volume == pytest.approx(24_000.0 * scale**3)
    assert solid.states_unit == stated


def test_the_users_unit_wins_and_is_told(tmp_path):
    path = written(tmp_path, "part.stl", stl_with_header(b"units=cm"))
    solid = read_solid(path, "inch")
    assert solid.volume == pytest.approx(24_000.0 * 25.4**3)
    assert "says cm" in solid.notes[0]
    assert read_solid(path, "cm").notes == ()
    assert read_triangles(path, "um").volume == pytest.approx(24_000e-9)
    with pytest.raises(VolfrepError, match="no unit 'parsec': choose one of um, mm"):
        read_solid(path, "parsec")


@pytest.mark.parametrize(("size", "unit"), [(0.1, "m"), (4.0, "cm"), (1.2e5, "um")])
def test_a_part_out_of_scale_is_asked_about(size, unit):
    box = np.array([[0.0, 0.0, 0.0], [size, size / 2, size / 3]])
    with pytest.raises(
        VolfrepError, match=rf"measures {re.escape(f'{size:.4g}')} x .*--unit {unit}\?"
    ):
        refuse_scale(box, 10.0, "part.stl")
    refuse_scale(np.array([[0.0] * 3, [121.0, 28.0, 11.6]]), 10.0, "part.stl")


def test_the_command_asks_for_the_unit_and_takes_it(tmp_path, capsys):
    path = written(tmp_path, "part.stl", stl_with_header(b""))
    out = tmp_path / "out.stl"
    arguments = ["fill", str(path), "-o", str(out), "--cell", "Box", "--strut-radius", "50"]
    arguments += ["--cell-size", "500", "--shell", "100", "--resolution", "12"]
    assert cli.run(arguments) == 2
    assert "40 x 30 x 20 mm, too small for cells of 500 mm: which unit" in capsys.readouterr().err
    assert cli.run([*arguments, "--unit", "inch"]) == 0
    assert read_triangles(out).bounds[1] == pytest.approx([1016.0, 762.0, 508.0])
