# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls of surfaces that repeat: as thick as wanted, of the genus of theory, closed in one body."""

from functools import cache

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree
from skimage.measure import marching_cubes

import samples
import volfrep
from contract import assert_same_quality, check_contract
from volfrep import LatticeSpec, StageCache, VolfrepError
from volfrep.cli import command as cli
from volfrep.design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
from volfrep.design.openings import OpenPlane
from volfrep.design.parameters.specification import specification, values_of
from volfrep.design.profile import Profile
from volfrep.design.target import Target
from volfrep.design.tpms import SURFACES, PeriodicSurface, TpmsSheet
from volfrep.io.solid import check_solid
from volfrep.io.write.stl import as_read
from volfrep.jobs.blocks import block, write_block_stl
from volfrep.jobs.infill import Infill
from volfrep.lattice.assembly import lay, lay_out
from volfrep.lattice.certificate import agree_on_faces, certify
from volfrep.mesh.quality import measure
from volfrep.octants.octant import OctantGrid, octant_mirrors
from volfrep.spatial.even_points import even_points
from volfrep.spatial.piercing import piercing_pairs
from volfrep.tpms.midsurface import midsurface
from volfrep.tpms.octants import closed_octants, octants_of_cells
from volfrep.tpms.period import tpms_octants
from volfrep.tpms.solid import TpmsSolid
from volfrep.util.progress import Monitor

SIZE = 10.0
#: Genus of the surface on one period of its cubic cell: 1 - chi / 2, with chi from its genus in a
#: primitive cell and how many of these a cubic one holds (Schoen 1970; Karcher 1989).
GENUS = {"Gyroid": 5, "Schwarz P": 3, "Schwarz D": 9, "IWP": 7, "Neovius": 9}
NO_ENDS = (False, False, False)


@cache
def octants(name, kind="sheet", thickness=1.0, facets=20):
    solid = TpmsSolid.of(SURFACES[name], TpmsSheet(kind, thickness), SIZE)
    return tpms_octants(solid, SIZE, facets, Monitor())


def endless(found):
    """One period that closes upon itself."""
    kind = octant_mirrors((2, 2, 2)).astype(np.int16)
    grid = OctantGrid(list(found), kind, np.zeros(3), SIZE, False, (True, True, True))
    return lay_out(grid, found)


def laid_block(found, count):
    active = np.ones((count,) * 3, bool)
    grid = octants_of_cells(active, SIZE, np.zeros(3), NO_ENDS)
    return lay_out(grid, closed_octants(found, grid.keys, 0.5 * SIZE).octants)


def counted(name, thickness, points_log2):
    """Share of points in a sheet, by marching cubes on the formula written out here."""
    steps = 80
    x, y, z = np.meshgrid(*[np.arange(steps + 1) * 2.0 * np.pi / steps] * 3, indexing="ij")
    values = {
        "Gyroid": np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x),
        "Schwarz P": np.cos(x) + np.cos(y) + np.cos(z),
    }[name]
    found, _, normals, _ = marching_cubes(values, 1e-9)
    found = found / steps % 1.0 % 1.0
    points = even_points(3, points_log2)
    away, row = cKDTree(found, boxsize=1.0).query(points, distance_upper_bound=thickness)
    near = np.isfinite(away)
    gap = points[near] - found[row[near]]
    gap -= np.round(gap)
    return np.count_nonzero(
        np.abs(np.einsum("ij,ij->i", gap, normals[row[near]])) <= 0.5 * thickness
    ) / len(points)


def across(mesh, chosen):
    """How far from the middles of some facets the mesh is met again, straight inwards.

    T. Moeller and B. Trumbore, J. Graphics Tools 2, 1997.
    """
    a, b, c = mesh.corners()
    middle = (a + b + c) / 3.0
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    near = cKDTree(middle).query_ball_point(middle[chosen], 2.5)
    ray = np.repeat(np.arange(len(chosen)), [len(rows) for rows in near])
    facet = np.concatenate(near).astype(int)
    start, way = middle[chosen][ray], -normal[chosen][ray]
    one, two = b[facet] - a[facet], c[facet] - a[facet]
    side = np.cross(way, two)
    size = np.einsum("ij,ij->i", one, side)
    with np.errstate(divide="ignore", invalid="ignore"):
        gap = start - a[facet]
        u = np.einsum("ij,ij->i", gap, side) / size
        turned = np.cross(gap, one)
        v = np.einsum("ij,ij->i", way, turned) / size
        length = np.einsum("ij,ij->i", two, turned) / size
    hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (length > 1e-3)
    result = np.full(len(chosen), np.inf)
    np.minimum.at(result, ray[hit], length[hit])
    return result


@pytest.mark.slow_but("Gyroid")
@pytest.mark.parametrize("name", GENUS)
def test_an_endless_sheet_has_two_sides_of_the_genus_of_theory(name) -> None:
    found = certify(endless(octants(name)))
    assert (found.shells, found.genus) == (2, 2 * GENUS[name])


@pytest.mark.parametrize("kind", ["skeleton", "complement"])
def test_an_endless_skeleton_has_one_surface_of_the_genus_of_theory(kind) -> None:
    found = certify(endless(octants("Gyroid", kind)))
    assert (found.shells, found.genus) == (1, GENUS["Gyroid"])


def test_blocks_of_gyroid_grow_by_a_genus_of_three_for_each_primitive_cell() -> None:
    # Two primitive cells in a cubic one, each with an Euler characteristic of 2 - 2 x 3, on both
    # sides of the sheet. What faces, edges and corners add grows with lower powers of the count.
    euler = []
    for count in range(1, 5):
        found = certify(laid_block(octants("Gyroid"), count))
        assert (found.bodies, found.shells) == (1, 1)
        euler.append(2 - 2 * found.genus)
    assert np.diff(euler, 3)[0] == 6 * 2 * 2 * (2 - 2 * 3)


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.slow) if name not in ("Gyroid", "Neovius") else name
        for name in SURFACES
    ],
)
def test_what_is_proved_by_kinds_of_octants_holds_on_the_triangles(name) -> None:
    layout = laid_block(octants(name, thickness=0.6, facets=30), 2)
    assert_same_quality(certify(layout), measure(lay(layout, Monitor())))
    assert agree_on_faces(layout)


@pytest.mark.costly
def test_a_sheet_is_as_thick_as_wanted_from_side_to_side() -> None:
    found = octants("Gyroid", thickness=0.8, facets=30)
    mesh = lay(laid_block(found, 2), Monitor())
    middle = np.mean(mesh.corners(), axis=0)
    inner = ((middle > 3.0) & (middle < 17.0)).all(axis=1)
    found = across(mesh, np.flatnonzero(inner)[::101])
    assert np.median(found) == pytest.approx(0.8, rel=0.01)
    assert np.quantile(found, [0.03, 0.97]) == pytest.approx(0.8, rel=0.05)


def gyroids_distance(points):
    """How far points are from the gyroid, by Newton's method on its formula and along it."""
    turn = 2.0 * np.pi / SIZE

    def value(at):
        x, y, z = turn * at.T
        return np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)

    def slope(at):
        x, y, z = turn * at.T
        parts = [(np.cos(p) * np.cos(q) - np.sin(r) * np.sin(p))
                 for p, q, r in ((x, y, z), (y, z, x), (z, x, y))]  # fmt: skip
        return turn * np.stack(parts, axis=1)

    foot = points.copy()
    for _ in range(40):
        normal = slope(foot)
        size = np.einsum("ij,ij->i", normal, normal)[:, None]
        foot -= normal * value(foot)[:, None] / size
        gap = points - foot
        foot += 0.5 * (gap - normal * np.einsum("ij,ij->i", gap, normal)[:, None] / size)
    return np.linalg.norm(points - foot, axis=1)


def test_facets_stray_no_farther_than_the_deviation_allows() -> None:
    thickness, deviation = 0.5, 0.02
    spec = LatticeSpec("Gyroid", SIZE, wall=TpmsSheet("sheet", thickness), deviation=deviation)
    found = octants("Gyroid", thickness=thickness, facets=spec.facets_along_cell)
    a, b, c = lay(laid_block(found, 1), Monitor()).corners()
    middle = (a + b + c) / 3.0
    inner = ((middle > 0.05) & (middle < SIZE - 0.05)).all(axis=1)
    points = np.concatenate([middle[inner], 0.5 * (a + b)[inner]])
    strays = np.abs(gyroids_distance(points) - 0.5 * thickness)
    assert 0.5 * deviation < strays.max() < 1.5 * deviation


@pytest.mark.costly
@pytest.mark.parametrize(
    ("name", "thickness"),
    [("Gyroid", 0.12), pytest.param("Lidinoid", 0.16, marks=pytest.mark.slow)],
)
def test_a_thin_sheet_needs_facets_for_its_surface_and_not_for_its_thickness(name, thickness):
    """Each of its sides is met by a facet or two a thickness, where eight were."""
    facets = LatticeSpec(name, SIZE, wall=TpmsSheet("sheet", thickness)).facets_along_cell
    assert thickness < 0.75 * SIZE / facets
    mesh = lay(laid_block(octants(name, thickness=thickness, facets=facets), 1), Monitor())
    quality = measure(mesh)
    assert quality.watertight
    assert len(piercing_pairs(mesh)) == 0
    middle = np.mean(mesh.corners(), axis=0)
    inner = ((middle > 1.0) & (middle < 9.0)).all(axis=1)
    found = across(mesh, np.flatnonzero(inner)[::37])
    assert np.median(found) == pytest.approx(thickness, rel=0.02)
    assert np.quantile(found, [0.03, 0.97]) == pytest.approx(thickness, rel=0.15)


@pytest.mark.slow
def test_a_filled_part_does_not_run_through_itself() -> None:
    spec = LatticeSpec("Gyroid", 9.0, shell=1.0, resolution=16, wall=TpmsSheet("sheet", 1.2))
    made = volfrep.fill(samples.box((24.0, 20.0, 16.0)), spec)
    assert len(piercing_pairs(as_read(made.result.mesh))) == 0


@pytest.mark.slow_cases("Gyroid")
@pytest.mark.parametrize("name", ["Gyroid", pytest.param("Schwarz P", marks=pytest.mark.slow)])
def test_a_blocks_density_is_that_of_a_point_count(name) -> None:
    report = block(LatticeSpec(name, SIZE, wall=TpmsSheet("sheet", 0.8)), (2, 2, 2)).report
    assert report.watertight
    assert report.bodies == 1
    assert report.relative_density == pytest.approx(counted(name, 0.08, 17), rel=3e-3)


@pytest.mark.slow
def test_a_skeleton_and_its_complement_fill_the_cell() -> None:
    spec = {"cell": "IWP", "cell_size": SIZE}
    one = block(LatticeSpec(**spec, wall=TpmsSheet("skeleton", offset=0.4)), (1, 1, 1)).report
    two = block(LatticeSpec(**spec, wall=TpmsSheet("complement", offset=-0.4)), (1, 1, 1)).report
    assert one.relative_density + two.relative_density == pytest.approx(1.0, abs=2e-3)
    assert one.relative_density > two.relative_density


@pytest.mark.costly
def test_a_streamed_block_is_the_same_as_one_held_whole(tmp_path) -> None:
    spec = LatticeSpec("Gyroid", SIZE, resolution=16, wall=TpmsSheet("sheet", 1.2))
    streamed = write_block_stl(spec, (2, 1, 2), tmp_path / "block.stl")
    whole = block(spec, (2, 1, 2))
    read = trimesh.load(tmp_path / "block.stl")
    assert read.is_watertight
    assert read.volume == pytest.approx(whole.mesh.volume, rel=1e-6)
    assert (streamed.triangles, streamed.genus) == (whole.report.triangles, whole.report.genus)


_stages = StageCache()


@pytest.mark.costly
@pytest.mark.slow_cases("no skin", "skeleton")
@pytest.mark.parametrize(
    "settings",
    [
        {"cell": "Gyroid"},
        {"cell": "Gyroid", "shell": 0.0},
        {"cell": "Schwarz D", "wall": TpmsSheet("skeleton")},
        pytest.param(
            {"cell": "Neovius", "wall": TpmsSheet("complement", offset=-0.3), "output": "lattice"},
            marks=pytest.mark.slow,
        ),
        pytest.param(
            {"cell": "Gyroid", "orientation": Orientation((1.0, 2.0, 3.0), 25.0)},
            marks=pytest.mark.slow,
        ),
    ],
    ids=["skin", "no skin", "skeleton", "complement", "turned"],
)
def test_a_part_filled_with_walls_keeps_the_contract(settings) -> None:
    given = {"cell_size": 12.0, "shell": 1.5, "resolution": 18, **settings}
    spec = LatticeSpec(**{"wall": TpmsSheet("sheet", 1.2), **given})
    check_contract(check_solid(samples.bracket(33.0), "bracket"), spec, (), _stages)


@pytest.mark.slow
def test_graded_walls_have_their_thickness_in_the_part() -> None:
    grading = RadiusGrading("direction", Profile("linear", 0.6, 1.6), (0.0, 0.0, 1.0))
    spec = LatticeSpec(
        "Schwarz P", 8.0, shell=0.0, radius_grading=grading, resolution=24,
        size_grading=SizeGrading(Profile("linear", 1.0, 1.5), (1.0, 0.0, 0.0)),
    )  # fmt: skip
    mesh = block(spec, (3, 2, 3)).mesh
    assert measure(mesh).watertight
    middle, (low, high) = np.mean(mesh.corners(), axis=0), mesh.bounds
    inner = ((middle > low + 2.5) & (middle < high - 2.5)).all(axis=1)
    chosen = np.flatnonzero(inner)[::151]
    share = across(mesh, chosen) / (0.6 + middle[chosen, 2] / 24.0)
    assert np.median(share) == pytest.approx(1.0, abs=0.02)
    assert np.quantile(share, [0.05, 0.95]) == pytest.approx(1.0, abs=0.1)


@pytest.mark.slow
def test_walls_in_a_part_with_an_open_face_keep_the_contract() -> None:
    spec = LatticeSpec("Schwarz P", 9.0, shell=1.0, resolution=16, wall=TpmsSheet("sheet", 1.2),
                       open_faces=(OpenPlane((0, 0, 18), (0, 0, 1)),))  # fmt: skip
    check_contract(check_solid(samples.box((30.0, 28.0, 18.0)), "box"), spec, ())


@pytest.mark.slow
def test_walls_about_an_axis_keep_the_contract() -> None:
    spec = LatticeSpec("Gyroid", 9.0, shell=1.0, resolution=16, cell_map=CellMap("cylindrical"),
                       wall=TpmsSheet("sheet", 1.2))  # fmt: skip
    check_contract(check_solid(samples.box((30.0, 28.0, 18.0)), "box"), spec, ())


@pytest.mark.slow_cases("target0-wall0")
@pytest.mark.parametrize(
    ("target", "wall"),
    [
        (Target("relative_density", 0.2), TpmsSheet()),
        pytest.param(
            Target("relative_density", 0.35), TpmsSheet("skeleton"), marks=pytest.mark.slow
        ),
        pytest.param(Target("mass", 3.5), TpmsSheet(), marks=pytest.mark.slow),
    ],
)
def test_walls_come_out_with_their_target(target, wall) -> None:
    spec = LatticeSpec("Gyroid", 10.0, shell=1.0, resolution=18, wall=wall, target=target)
    made = volfrep.fill(samples.box((20.0, 15.0, 15.0)), spec)
    report = made.report
    reached = report.mass_g if target.aim == "mass" else report.relative_density
    assert reached == pytest.approx(target.value, rel=5e-3)
    assert report.target["reached"] == reached


@pytest.mark.costly
def test_a_formula_of_ones_own_is_the_same_as_the_librarys() -> None:
    own = PeriodicSurface("Formula", "cos(x) + cos(y) + cos(z)")
    reports = [
        block(
            LatticeSpec(cell, SIZE, resolution=16, wall=TpmsSheet("sheet", 1.2)), (1, 1, 1)
        ).report
        for cell in (own, "schwarz primitive")
    ]
    assert reports[0].volume_mm3 == reports[1].volume_mm3


@pytest.mark.parametrize(
    ("formula", "said"),
    [
        ("cos(x) + 3", "nowhere zero"),
        ("x + y + z - 9", "must repeat after 2 pi along x"),
        ("log(cos(x))", "finite value"),
        ("cos(x) + w", "'w' is not known: use numbers, x, y, z,"),
        ("0.5 - step(3, x)", "must repeat"),
        ("step(1, cos(y) + 1.3) - 0.5", "jumps"),
        ("", "needs a formula"),
    ],
)
def test_a_formula_that_is_no_surface_is_refused(formula, said) -> None:
    with pytest.raises(VolfrepError, match=said):
        midsurface(PeriodicSurface("Formula", formula)) if formula else LatticeSpec("Formula")


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"wall": TpmsSheet("sheet", 10.0)}, "too thick for a cell"),
        ({"fillet": 0.5}, "fillet is not for walls"),
        ({"remove_dangling": True}, "removal of struts is not for walls"),
        ({"wall": TpmsSheet("sheet", 0.005)}, "limit is 400"),
        ({"boundary": "whole"}, "cut at the wall"),
        ({"activation": "inside"}, "cut at the wall"),
    ],
)
def test_what_is_of_struts_is_refused(settings, said) -> None:
    with pytest.raises(VolfrepError, match=said):
        LatticeSpec("Gyroid", SIZE, **settings)


def test_walls_are_not_beams() -> None:
    infill = Infill(check_solid(samples.box(), "box"), LatticeSpec("Gyroid", SIZE))
    for stage in ("beams", "axes", "lattice_beams"):
        with pytest.raises(VolfrepError, match="no struts"):
            getattr(infill, stage)


@pytest.mark.parametrize(
    "values",
    [
        {"cell": "Gyroid", "wall_thickness": 0.6},
        {"cell": "split p", "wall_kind": "skeleton", "wall_offset": -0.2},
        {"cell": "Formula", "wall_formula": "cos(x) + cos(y) + cos(2*z)"},
        {"cell": "Gyroid", "relative_density": 0.2},
        {"cell": "Gyroid", "radius_grading": "skin", "radius_end": 2.0},
    ],
)
def test_a_specification_of_walls_is_that_of_its_values(values) -> None:
    spec = specification(values)
    assert specification(values_of(spec)) == spec
    assert "strut_radius" not in values_of(spec)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--cell", "gyroid", "--strut-radius", "1"], "no effect with such a --cell"),
        (["--cell", "CVC", "--wall-thickness", "1"], "no effect without --cell Gyroid"),
        (["--cell", "gyroid", "--wall-offset", "1"], "no effect without --wall-kind skeleton"),
        (["--cell", "gyroid", "--wall-thickness", "1", "--mass", "3"], "how thick the walls are"),
        (["--cell", "formula"], "needs --wall-formula"),
    ],
)
def test_the_command_refuses_what_has_no_effect(options, said, tmp_path, capsys) -> None:
    out = tmp_path / "block.stl"
    assert cli.run(["block", "-o", str(out), "--count", "1,1,1", *options]) == 2
    assert said in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.costly
def test_the_command_fills_a_part_with_walls(tmp_path, capsys) -> None:
    part, out = tmp_path / "box.stl", tmp_path / "out.stl"
    trimesh.creation.box((24, 20, 16)).export(part)
    options = ["--cell", "gyroid", "--wall-thickness", "1.2", "--shell", "1", "--resolution", "16"]
    assert cli.run(["fill", str(part), "-o", str(out), *options]) == 0
    told = capsys.readouterr().out
    assert "Gyroid, sheet, 1.2 mm thick" in told
    assert "strut" not in told
    assert cli.run(["check", str(out)]) == 0
    assert "bodies          1\n" in capsys.readouterr().out
