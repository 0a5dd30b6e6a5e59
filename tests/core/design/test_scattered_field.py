# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields at scattered points: between the points, from files, and as radii."""

import math
import sys
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from volfrep.design import field_files, vtk_files
from volfrep.design.grading import read_point_field
from volfrep.design.scattered_field import (
    CHUNK,
    NEIGHBOURS,
    PointField,
    TransferCurve,
    default_curve,
)
from volfrep.util.errors import VolfrepError

NO_MESHIO = "fields from VTK files need the package meshio"


def cloud(count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-10, 10, (count, 3))


# --- between the points


@settings(max_examples=100)
@given(count=st.integers(1, 40), seed=st.integers(0, 2**32 - 1))
def test_the_field_is_exact_at_its_points_and_within_range_elsewhere(count: int, seed: int) -> None:
    points = cloud(count, seed)
    values = np.random.default_rng(seed + 1).normal(size=count)
    field = PointField(points, values)
    np.testing.assert_array_equal(field(points), values)
    elsewhere = field(cloud(100, seed + 2) * 10)
    assert values.min() <= elsewhere.min()
    assert elsewhere.max() <= values.max()


@pytest.mark.parametrize("count", range(1, NEIGHBOURS + 1))
def test_few_points_all_have_their_say(count: int) -> None:
    points, places = cloud(count), cloud(50, 1)
    values = np.arange(count) ** 2.0
    distance = np.linalg.norm(places[:, None] - points, axis=2)
    expected = (values / distance**2).sum(axis=1) / (1 / distance**2).sum(axis=1)
    np.testing.assert_allclose(PointField(points, values)(places), expected, rtol=1e-12)


def test_many_points_by_the_formula_of_franke_and_little() -> None:
    points, places = cloud(200), cloud(50, 1)
    values = np.sin(points[:, 0])
    expected = []
    for place in places:
        distance = np.linalg.norm(points - place, axis=1)
        order = distance.argsort()
        rim, near = distance[order[8]], order[:8]
        weight = ((rim - distance[near]) / (rim * distance[near])) ** 2
        expected.append((weight * values[near]).sum() / weight.sum())
    np.testing.assert_allclose(PointField(points, values)(places), expected, rtol=1e-9)


def test_the_field_has_no_jumps() -> None:
    field = PointField(cloud(300), np.random.default_rng(3).uniform(0, 1, 300))
    line = np.zeros((200_001, 3))
    line[:, 0] = np.linspace(-9, 9, len(line))
    assert np.abs(np.diff(field(line))).max() < 1e-3


def test_a_finer_cloud_comes_nearer_to_the_function_it_samples() -> None:
    def function(p: np.ndarray) -> np.ndarray:
        return np.sin(0.3 * p[:, 0]) + 0.05 * p[:, 1] * p[:, 2]

    places = cloud(2000, 5) * 0.9
    errors = []
    for count in (500, 4000, 32000):
        points = cloud(count, 6)
        miss = PointField(points, function(points))(places) - function(places)
        errors.append(np.sqrt((miss**2).mean()))
    assert errors[1] < 0.7 * errors[0]
    assert errors[2] < 0.7 * errors[1]


def test_a_regular_grid_is_not_a_special_case() -> None:
    axis = np.arange(5.0)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    field = PointField(points, points[:, 0])
    centre = np.array([[1.5, 1.5, 1.5], [1.5, 2.0, 2.0], [2.5, 1.5, 2.5]])
    np.testing.assert_allclose(field(centre), centre[:, 0], atol=1e-6)


def test_where_all_nine_are_as_far_their_mean_counts() -> None:
    turn = np.arange(9) * 2 * np.pi / 9
    ring = np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    assert PointField(ring, np.full(9, 4.0))([[0.0, 0.0, 0.0]])[0] == 4.0
    assert 0.9 < PointField(ring, np.arange(9) / 4)([[0.0, 0.0, 0.0]])[0] < 1.1


def test_points_in_one_place_count_once_with_their_mean() -> None:
    points = [[0, 0, 0], [1, 0, 0], [0, 0, 0], [-0.0, 0, 0]]
    field = PointField(np.array(points, float), np.array([1.0, 10.0, 2.0, 6.0]))
    np.testing.assert_array_equal(field.points, [[0, 0, 0], [1, 0, 0]])
    np.testing.assert_array_equal(field.values, [3.0, 10.0])
    assert field([[0.5, 0, 0]])[0] == 6.5
    assert field.range == (3.0, 10.0)
    np.testing.assert_array_equal(field.bounds, [[0, 0, 0], [1, 0, 0]])


def test_points_very_near_and_places_very_far_stay_finite() -> None:
    field = PointField(np.array([[0, 0, 0], [1e-200, 0, 0], [1, 0, 0]]), np.array([1.0, 2, 3]))
    values = field([[0, 0, 0], [1e-200, 0, 0], [1e-180, 0, 0], [1e9, 1e9, 1e9]])
    assert np.isfinite(values).all()
    assert values.min() >= 1.0
    assert values.max() <= 3.0


def test_any_number_of_places() -> None:
    field = PointField(cloud(20), np.arange(20.0))
    places = cloud(CHUNK + 7, 2)
    assert field(np.empty((0, 3))).shape == (0,)
    values = field(places)
    assert values.shape == (CHUNK + 7,)
    np.testing.assert_array_equal(values[-9:], field(places[-9:]))


@pytest.mark.parametrize(
    ("points", "values", "sentence"),
    [
        (np.empty((0, 3)), [], "no points"),
        (np.zeros((2, 2)), [1, 2], r"points \(n, 3\)"),
        (np.zeros((2, 3)), [1], r"points \(n, 3\)"),
        ([[0, 0, 0], [0, np.nan, 0]], [1, 2], "not finite, at point 1"),
        ([[0, 0, 0], [1, 1, 1]], [np.inf, 2], "not finite, at point 0"),
        ([[0, 0, 1e12]], [1], "1e.12 mm from the origin"),
    ],
)
def test_what_is_no_field_is_refused(points: Any, values: Any, sentence: str) -> None:
    with pytest.raises(VolfrepError, match=sentence):
        PointField(np.array(points), np.array(values))


# --- tables

TABLES = {
    "commas": "x,y,z,value\n0,0,0,1\n1.5,2,-3e0,4.25\n",
    "no header": "0,0,0,1\n1.5,2,-3e0,4.25\n",
    "blanks": "# a comment, with commas\n\n 0 0   0 1\n1.5 2\t-3 4.25 # the last\n",
    "decimal commas": "x;y;z;T\n0;0;0;1\n1,5;2,0;-3;4,25\n",
    "decimal commas and tabs": "0\t0\t0\t1\n1,5\t2,0\t-3\t4,25\n",
    "another order": "Stress [MPa];Z;y (mm);X\n1;0;0;0\n4.25;-3;2;1.5\n",
    "quotation marks": '"Points:0","Points:1","Points:2","T"\n"0","0","0","1"\n1.5,2,-3,4.25\n',
    "metres": "X Location (m)\tY Location (m)\tZ Location (m)\tT (K)\n"
    "0\t0\t0\t1\n0.0015\t0.002\t-0.003\t4.25\n",
    "byte order mark": "\ufeffx,y,z,\u03c3\r\n0,0,0,1\r\n1.5,2,-3,4.25",
}


@pytest.mark.parametrize("text", TABLES.values(), ids=TABLES)
def test_tables(text: str, tmp_path: Path) -> None:
    file = tmp_path / "field.csv"
    file.write_text(text, encoding="utf-8")
    field = read_point_field(file)
    np.testing.assert_allclose(field.points, [[1.5, 2, -3], [0, 0, 0]], rtol=1e-14)
    np.testing.assert_array_equal(field.values, [4.25, 1.0])


@pytest.mark.parametrize("name", ["s eq (MPa)", "S EQ (MPA)"])
def test_a_column_is_chosen_by_its_name(name: str, tmp_path: Path) -> None:
    file = tmp_path / "field.csv"
    file.write_text("node,x,y,z,T,s eq (MPa)\n1,0,0,0,300,7\n2,1,0,0,310,8\n")
    np.testing.assert_array_equal(read_point_field(file, name).values, [7, 8])
    with pytest.raises(VolfrepError, match=r"several columns: .* 'node', 'T', 's eq \(MPa\)'\.$"):
        read_point_field(file)
    with pytest.raises(VolfrepError, match=r"no column 'x': choose one of 'node', 'T'"):
        read_point_field(file, "x")


@settings(max_examples=50)
@given(
    rows=st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 4), min_size=1, max_size=20),
    separator=st.sampled_from([",", ";", "\t", " ", "  ", ", "]),
    header=st.booleans(),
)
def test_what_is_written_is_read(
    rows: list[tuple[float, ...]],
    separator: str,
    header: bool,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    file = tmp_path_factory.getbasetemp() / "written.txt"
    lines = [separator.join(map(repr, row)) for row in rows]
    file.write_text("\n".join([separator.join("xyzv")] * header + lines))
    found, expected = (
        read_point_field(file),
        PointField(*np.split(np.array(rows), [3], axis=1)[:1], np.array(rows)[:, 3]),
    )
    np.testing.assert_array_equal(found.points, expected.points)
    np.testing.assert_array_equal(found.values, expected.values)


BAD_TABLES = {
    "": "holds no points",
    "# nothing\n\n": "holds no points",
    "x,y,z,T\n": "no points below its header in line 1",
    "1,2,3\n": "has 3 columns and no header",
    "1,2,3,4,5\n": "has 5 columns and no header",
    "1,2,three,4\n": "line 1: 'three' is not a number",
    "a,b,c,d\n1,2,3,4\n": "must name columns x, y and z, and it names 'a', 'b', 'c', 'd'",
    "x,y,z\n1,2,3\n": "no column that holds a value",
    "x,y,z,X,T\n1,2,3,4,5\n": "two columns for x, 'x' and 'X'",
    "x (furlong),y,z,T\n1,2,3,4\n": r"'x \(furlong\)' is not in mm, cm, m, in",
    "x,y,z,T\n# ok\n1,2,3,4\n1,2,3\n": "line 4 has 3 columns and not 4",
    "x,y,z,T\n1,2,3,4\n\n1,2,3,4,5\n": "line 4 has 5 columns and not 4",
    "x,y,z,T\n1,2,3,4,5\n": "line 2 has 5 columns and not 4",
    "x,y,z,T\n1,2,3,4\n1,2,,4\n": "line 3: '' is not a number",
    "x,y,z,T\n1,2,3,4\n1,2,3,4 MPa\n": "line 3: '4 MPa' is not a number",
    "x,y,z,T\n1,2,3,4\n1,2,3,nan\n": "line 3 holds a number that is not finite",
    "x,y,z,T\n1,-inf,3,4\n": "line 2 holds a number that is not finite",
    "1,5 2,0 3,1 7\n": "line 1: '5 2' is not a number",  # decimal commas
    "1.000,5;2;3;4\n": "line 1: '1.000,5' is not a number",
    "x,y,z,T\n1,2,3,1_000\n": "line 2: .* is not a number",
    "1,2,3,4\nx,y,z,T\n": "line 2: 'x' is not a number",
}


@pytest.mark.parametrize("text", BAD_TABLES)
def test_a_table_that_is_none_is_refused_with_its_line(text: str, tmp_path: Path) -> None:
    file = tmp_path / "field.csv"
    file.write_text(text)
    with pytest.raises(VolfrepError, match=BAD_TABLES[text]) as caught:
        read_point_field(file)
    assert "field.csv" in str(caught.value)


def test_a_column_without_a_header_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "field.csv"
    file.write_text("1,2,3,4\n")
    with pytest.raises(VolfrepError, match="no header, so no column 'T'"):
        read_point_field(file, "T")


def test_the_line_is_right_in_a_long_table_too(tmp_path: Path) -> None:
    file = tmp_path / "field.csv"
    lines = ["x,y,z,T"] + ["1,2,3,4", "# comment"] * 60_000
    lines[110_000 - 1] = "1,2,3,inf" if lines[110_000 - 1] == "1,2,3,4" else "1,2,3,nan"
    file.write_text("\n".join(lines))
    with pytest.raises(VolfrepError, match="line 110000 holds"):
        read_point_field(file)


def test_a_text_that_is_not_utf8_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "field.csv"
    file.write_bytes("x,y,z,T\n1,2,3,4\n".encode("utf-16"))
    with pytest.raises(VolfrepError, match="not a text in UTF-8"):
        read_point_field(file)


@settings(max_examples=300)
@given(data=st.binary(max_size=60) | st.text('0123456789.,;\t \nxyzT#"-en', max_size=80))
def test_any_bytes_are_a_table_or_one_sentence(
    data: bytes | str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = tmp_path_factory.getbasetemp() / "any.csv"
    file.write_bytes(data if isinstance(data, bytes) else data.encode())
    try:
        found = read_point_field(file)
    except VolfrepError as error:
        assert "\n" not in str(error)  # noqa: PT017 - either outcome is right
    else:
        assert np.isfinite(found.points).all()


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("none.csv", "No such file"),
        ("field.xlsx", "not a kind of file that holds a field"),
        ("field.vtp", "save it as .vtu or CSV"),
        ("folder.csv", "is not a file"),
    ],
)
def test_what_is_no_such_file_is_refused(name: str, sentence: str, tmp_path: Path) -> None:
    (tmp_path / "folder.csv").mkdir()
    with pytest.raises(VolfrepError, match=sentence):
        read_point_field(tmp_path / name)


def test_a_file_too_large_is_refused_unread(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "field.csv"
    file.write_text("1,2,3,4\n" * 4)
    monkeypatch.setattr(field_files, "MAX_FILE_BYTES", 31)
    with pytest.raises(VolfrepError, match="at most 31 bytes"):
        read_point_field(file)
    monkeypatch.undo()
    monkeypatch.setattr(field_files, "MAX_POINTS", 3)
    with pytest.raises(VolfrepError, match="holds more than"):
        read_point_field(file)


def test_the_table_of_the_documentation_is_one(tmp_path: Path) -> None:
    page = Path(__file__).parents[3] / "docs" / "grading.md"
    file = tmp_path / "field.csv"
    file.write_text(page.read_text(encoding="utf-8").split("```csv\n")[1].split("```")[0])
    assert read_point_field(file).range == (9.7, 48.0)


# --- VTK files

TETRAHEDRA = np.arange(40).reshape(-1, 4)


def write_vtk(file: Path, **options: Any) -> np.ndarray:
    meshio = pytest.importorskip("meshio", reason=NO_MESHIO)
    points = cloud(40)
    data = {"stress": points @ [1.0, 2, 3], "displacement": points, "T": points[:, 0]}
    chosen = {k: data[k] for k in options.pop("arrays", data)}
    cells = {"element": [np.arange(10.0)]} if options.pop("cells", True) else {}
    mesh = meshio.Mesh(points, [("tetra", TETRAHEDRA)], point_data=chosen, cell_data=cells)
    mesh.write(file, **options)
    return points


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("a.vtu", {"binary": True, "compression": "zlib"}),
        ("a.vtu", {"binary": True, "compression": None}),
        ("a.vtu", {"binary": False}),
        ("a.VTK", {"file_format": "vtk42", "binary": True}),
        ("a.vtk", {"file_format": "vtk42", "binary": False}),
        ("a.vtk", {"file_format": "vtk", "binary": True}),
    ],
)
def test_vtk_files(name: str, options: dict[str, Any], tmp_path: Path) -> None:
    points = write_vtk(tmp_path / name, **options)
    field = read_point_field(tmp_path / name, "T")
    np.testing.assert_allclose(field(points), points[:, 0], rtol=1e-9)


@pytest.mark.costly
def test_vtk_files_of_vtks_own(tmp_path: Path) -> None:
    pytest.importorskip("meshio", reason=NO_MESHIO)
    vtk = pytest.importorskip("vtk", reason="needs VTK's own writers")
    points = cloud(40)
    grid = vtk.vtkUnstructuredGrid()
    places = vtk.vtkPoints()
    places.SetDataTypeToDouble()
    stress = vtk.vtkDoubleArray()
    stress.SetName("von Mises")
    for point in points.tolist():
        places.InsertNextPoint(point)
        stress.InsertNextValue(sum(point))
    grid.SetPoints(places)
    for tetrahedron in TETRAHEDRA.tolist():
        grid.InsertNextCell(vtk.VTK_TETRA, 4, tetrahedron)
    grid.GetPointData().AddArray(stress)
    for suffix, writer in (
        (".vtu", vtk.vtkXMLUnstructuredGridWriter()),
        (".vtk", vtk.vtkUnstructuredGridWriter()),
    ):
        file = tmp_path / f"vtk{suffix}"
        writer.SetFileName(str(file))
        writer.SetInputData(grid)
        assert writer.Write()
        field = read_point_field(file, "von Mises")
        np.testing.assert_allclose(field(points), points.sum(axis=1), rtol=1e-5)


def test_a_voxel_image_in_a_legacy_file(tmp_path: Path) -> None:
    pytest.importorskip("meshio", reason=NO_MESHIO)
    file = tmp_path / "image.vtk"
    file.write_text(
        "# vtk DataFile Version 3.0\nimage\nASCII\nDATASET STRUCTURED_POINTS\n"
        "DIMENSIONS 2 2 3\nORIGIN 1 0 0\nSPACING 1 2 3\nPOINT_DATA 12\n"
        "SCALARS density double 1\nLOOKUP_TABLE default\n" + " ".join(map(str, range(12)))
    )
    places = [[1, 0, 0], [2, 0, 0], [1, 2, 0], [1, 0, 6]]
    np.testing.assert_array_equal(read_point_field(file)(places), [0, 1, 2, 8])


@pytest.mark.parametrize(
    ("arrays", "column", "sentence"),
    [
        (["stress", "T"], None, "several arrays: choose one of 'stress', 'T'"),
        (["stress", "T"], "heat", "no array 'heat': choose one of 'stress', 'T'"),
        (["T", "displacement"], "displacement", "several components a point: choose one of 'T'"),
        (["T"], "element", "'element' in its cells and not at its points: convert it"),
        ([], None, "'element' in its cells and not at its points: convert it"),
    ],
)
def test_an_array_that_cannot_be_taken_is_refused(
    arrays: list[str], column: str | None, sentence: str, tmp_path: Path
) -> None:
    write_vtk(tmp_path / "a.vtu", arrays=arrays)
    with pytest.raises(VolfrepError, match=sentence):
        read_point_field(tmp_path / "a.vtu", column)


def test_a_vtk_file_that_defines_entities_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.vtu"
    path.write_text('<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "aaaa">]><VTKFile>&a;</VTKFile>')
    with pytest.raises(VolfrepError, match=r"'a.vtu' declares an XML document type"):
        read_point_field(path)


def test_values_that_are_not_finite_are_refused_with_their_point(tmp_path: Path) -> None:
    values = np.arange(40.0)
    values[7] = np.nan
    meshio = pytest.importorskip("meshio", reason=NO_MESHIO)
    mesh = meshio.Mesh(cloud(40), [("tetra", TETRAHEDRA)], point_data={"T": values})
    mesh.write(tmp_path / "a.vtu")
    with pytest.raises(VolfrepError, match=r"'a.vtu', point 7 of 'T' .* not finite"):
        read_point_field(tmp_path / "a.vtu")


@pytest.mark.parametrize("name", ["a.vtu", "a.vtk"])
@given(seed=st.integers(0, 2**32 - 1))
def test_damaged_vtk_files_are_read_or_refused(
    name: str, seed: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = tmp_path_factory.getbasetemp() / name
    write_vtk(file)
    random = np.random.default_rng(seed)
    data = bytearray(file.read_bytes())
    for _ in range(random.integers(1, 4)):
        at = int(random.integers(len(data)))
        data[at : at + int(random.integers(0, 9))] = random.bytes(int(random.integers(0, 3)))
    file.write_bytes(data[: int(random.integers(1, 3 * len(data)))])
    try:
        field = read_point_field(file, "T")
    except VolfrepError as error:
        assert name in str(error)  # noqa: PT017 - either outcome is right
    else:
        assert np.isfinite(field.values).all()


@pytest.mark.parametrize(
    "line",
    ["DIMENSIONS 100000 100000 100000", "POINTS 999999999999 double", "CELLS 2 99999999999"],
)
def test_a_legacy_file_that_promises_more_than_it_has_is_refused(line: str, tmp_path: Path) -> None:
    pytest.importorskip("meshio", reason=NO_MESHIO)
    file = tmp_path / "bomb.vtk"
    file.write_text(
        f"# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n{line}\n1 2 3\n"
    )
    with pytest.raises(VolfrepError, match="it promises"):
        read_point_field(file)


def test_without_meshio_the_sentence_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.vtu").write_text("<VTKFile/>")
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(VolfrepError, match="pip install meshio"):
        read_point_field(tmp_path / "a.vtu")


# --- radii


def test_a_curve_is_straight_between_its_pairs_and_level_beyond() -> None:
    curve = TransferCurve((0, 10, 20), (0.5, 1, 3))
    np.testing.assert_allclose(curve([[-5, 0, 5], [15, 20, 99]]), [[0.5, 0.5, 0.75], [2, 3, 3]])
    assert TransferCurve([1, 2], [3.0, 1.0])(1.5) == 2.0
    assert curve == TransferCurve([0.0, 10.0, 20.0], np.array([0.5, 1.0, 3.0]))
    assert hash(curve) == hash(TransferCurve([0.0, 10.0, 20.0], np.array([0.5, 1.0, 3.0])))


@given(
    pairs=st.lists(
        st.tuples(st.floats(-1e6, 1e6), st.floats(1e-3, 1e3)),
        min_size=2,
        max_size=9,
        unique_by=lambda p: p[0],
    ),
    falling=st.booleans(),
    places=st.lists(st.floats(-2e6, 2e6), min_size=1),
)
@example(
    pairs=[(0.0, 1.4281025237604865), (-450062.5, 256.0)],
    falling=True,
    places=[-1.4881134294462808e-23],
)
@example(  # so near that the slope between them is infinite
    pairs=[(0.0, 1.0), (2e-311, 2.0), (1.0, 3.0)],
    falling=False,
    places=[0.0, 5e-312, 1e-311, 1.5e-311, 2e-311, 0.5],
)
@example(pairs=[(0.0, 1.0), (5e-324, 2.0)], falling=True, places=[0.0, 5e-324, 1e-323])
def test_a_curve_is_monotone(
    pairs: list[tuple[float, float]], falling: bool, places: list[float]
) -> None:
    values = sorted(v for v, _ in pairs)
    radii = sorted((r for _, r in pairs), reverse=falling)
    found = TransferCurve(values, radii)(np.sort(places))
    steps = np.diff(found) * (-1 if falling else 1)
    assert (steps >= -1e-9 * max(radii)).all()
    assert min(radii) <= found.min()
    assert found.max() <= max(radii)


@pytest.mark.parametrize(
    ("values", "radii", "sentence"),
    [
        ([1], [1], "two or more values"),
        ([1, 2], [1], "not 2 and 1"),
        ([1, 1], [1, 2], "must ascend: 1 follows 1"),
        ([1, 3, 2], [1, 2, 3], "must ascend: 2 follows 3"),
        ([1, 2, 3], [1, 2, 1], "they turn at the value 2"),
        ([1, 2, 3, 4], [2, 2, 1, 3], "they turn at the value 3"),
        ([1, 2], [0, 1], "above 0 mm, not 0"),
        ([1, 2], [1, math.nan], "radii must be finite"),
        ([1, math.inf], [1, 2], "values must be finite"),
        (["a", "b"], [1, 2], "values must be numbers"),
    ],
)
def test_what_is_no_curve_is_refused(values: Any, radii: Any, sentence: str) -> None:
    with pytest.raises(VolfrepError, match=sentence):
        TransferCurve(values, radii)


def test_the_default_curve_spans_the_field() -> None:
    curve = default_curve(np.array([3.0, -1.0, 7.0]), 0.4, 1.2)
    np.testing.assert_allclose(curve([-1, 3, 7]), [0.4, 0.8, 1.2])
    np.testing.assert_allclose(default_curve([0, 2], 2, 1)([0, 2]), [2, 1])


@pytest.mark.parametrize(
    ("values", "sentence"),
    [([5.0, 5.0], "is 5 everywhere"), ([], "no points"), ([1.0, math.nan], "finite")],
)
def test_a_field_without_a_span_has_no_default_curve(values: list[float], sentence: str) -> None:
    with pytest.raises(VolfrepError, match=sentence):
        default_curve(values, 0.4, 1.2)


@pytest.mark.costly_cases("lzma")
@pytest.mark.parametrize("compressor", ["zlib", "lzma"])
def test_what_a_compressed_file_is_inflated_to_is_bounded(tmp_path, monkeypatch, compressor):
    """Zeros are packed a thousand times: a small file may hold more than any memory."""
    meshio = pytest.importorskip("meshio")
    points = np.zeros((40_000, 3))
    points[:, 0] = np.arange(40_000)
    mesh = meshio.Mesh(points, [("vertex", np.arange(40_000)[:, None])], {"T": points[:, 0]})
    path = tmp_path / "bomb.vtu"
    meshio.vtu.write(path, mesh, compression=compressor)
    assert len(read_point_field(path).values) == 40_000
    monkeypatch.setattr(vtk_files, "MAX_INFLATED_BYTES", 500_000)
    with pytest.raises(VolfrepError, match="holds more than 0 MB of numbers once it is decomp"):
        read_point_field(path)
    assert meshio.vtu._vtu.zlib is zlib
