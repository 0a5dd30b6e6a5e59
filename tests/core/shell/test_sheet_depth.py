# SPDX-License-Identifier: LGPL-2.1-or-later
"""Skins that are not alike everywhere, against closed forms."""

import math

import numpy as np
import pytest
import trimesh

import samples
from volfrep import LatticeSpec, Part, VolfrepError, fill
from volfrep.design.openings import OpenPatch, OpenPlane, SmoothFace
from volfrep.design.skins.kept_bodies import KeptBody
from volfrep.design.skins.own_faces import FaceSkin, KeptFace
from volfrep.design.spec_parts import Skin
from volfrep.io.solid import check_solid
from volfrep.jobs.preview import PartDepth, preview
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.reports.facet_roles import LATTICE, WALL, kinds_of_triangles
from volfrep.shell.domain import find_domain
from volfrep.spatial.proximity import closest_points
from volfrep.spatial.self_intersection import crossing_edges
from volfrep.util.progress import Monitor

BOX = samples.box((30.0, 20.0, 16.0))
TOP = OpenPlane((0, 0, float(BOX.bounds[1, 2])), (0, 0, 1))
SIDE = OpenPlane((float(BOX.bounds[1, 0]), 0, 0), (1, 0, 0))
BOTTOM = OpenPlane((0, 0, float(BOX.bounds[0, 2])), (0, 0, 1))


def _solid(mesh: trimesh.Trimesh) -> TriangleMesh:
    return check_solid(TriangleMesh(mesh.vertices, mesh.faces.astype(np.int32)), "part")


def _body(size: tuple[float, float, float], at: tuple[float, float, float]) -> KeptBody:
    mesh = trimesh.creation.box(size)
    mesh.apply_translation(BOX.bounds.mean(axis=0) + np.array(at))
    return KeptBody(mesh.vertices, mesh.faces)


def _plate(radius: float) -> TriangleMesh:
    """A plate of 30 x 20 x 16 with a hole through its middle."""
    hole = trimesh.creation.cylinder(radius, 20.0, sections=192)
    return _solid(trimesh.creation.box((30, 20, 16)).difference(hole, engine="manifold"))


def _cavity(solid: TriangleMesh, skin: Skin) -> TriangleMesh:
    found = find_domain(solid, skin, Monitor())
    quality = measure(found.mesh)
    assert quality.watertight
    assert not found.warnings
    every = np.ones(len(found.mesh.triangles), bool)
    assert not len(crossing_edges(found.mesh, every, 1e-6)[0])
    return found.mesh


@pytest.mark.costly_cases("kept", "open body")
@pytest.mark.slow_but("thin", "open body", "kept", "flush body")
@pytest.mark.parametrize(
    ("skin", "volume"),
    [
        (Skin(1.0, (), (FaceSkin(TOP, 3.0),)), 28 * 18 * 12),
        (Skin(3.0, (), (FaceSkin(TOP, 1.0),)), 24 * 14 * 12),
        (Skin(1.0, (), (FaceSkin(TOP, 3.0), FaceSkin(SIDE, 2.0))), 27 * 18 * 12),
        (Skin(1.0, (BOTTOM,), (FaceSkin(TOP, 3.0),)), 28 * 18 * 13),
        (Skin(1.0, (), (), (KeptFace(TOP, 5.0),)), 28 * 18 * 10),
        (Skin(1.0, (), (), (_body((8, 8, 40), (0, 0, 0)),)), (28 * 18 - 64) * 14),
        (Skin(1.0, (), (), (_body((8, 8, 4), (0, 0, 0)),)), 28 * 18 * 14 - 256),
        (Skin(1.0, (), (), (_body((28, 18, 7), (0, 0, 3.5)),)), 28 * 18 * 7),
        (Skin(1.0, (BOTTOM,), (), (_body((8, 8, 40), (0, 0, 0)),)), (28 * 18 - 64) * 15),
    ],
    ids=[
        "thick",
        "thin",
        "two",
        "beside open",
        "kept",
        "body",
        "island",
        "flush body",
        "open body",
    ],
)
def test_a_box_has_the_cavity_of_its_skins(skin: Skin, volume: float) -> None:
    assert _cavity(BOX, skin).volume == pytest.approx(volume, rel=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize(("shell", "own"), [(1.0, 4.0), (2.0, 1.0)])
def test_a_hole_has_a_bush_as_thick_as_its_skin(shell: float, own: float) -> None:
    at = SmoothFace((3.0, 0.0, 0.0))
    inner = [size - 2.0 * shell for size in (30, 20, 16)]
    wanted = (inner[0] * inner[1] - math.pi * (3.0 + own) ** 2) * inner[2]
    made = _cavity(_plate(3.0), Skin(shell, (), (FaceSkin(at, own),)))
    assert made.volume == pytest.approx(wanted, rel=1e-3)


@pytest.mark.slow
def test_what_is_kept_solid_round_a_hole_is_as_if_its_skin_were_so_thick() -> None:
    at, solid = SmoothFace((3.0, 0.0, 0.0)), _plate(3.0)
    own = _cavity(solid, Skin(2.0, (), (FaceSkin(at, 3.0),)))
    kept = _cavity(solid, Skin(2.0, (), (), (KeptFace(at, 3.0),)))
    assert kept.volume == pytest.approx(own.volume, rel=1e-6)


@pytest.mark.costly
def test_a_cylinder_has_its_mantle_and_its_top_apart() -> None:
    rod = _solid(trimesh.creation.cylinder(10, 30, sections=256))
    mantle, top = SmoothFace((10, 0, 0)), SmoothFace((0, 0, 15))
    made = _cavity(rod, Skin(1.0, (), (FaceSkin(mantle, 4.0), FaceSkin(top, 2.0))))
    assert made.volume == pytest.approx(math.pi * 36 * 27, rel=2e-3)


@pytest.mark.costly
def test_where_a_thick_skin_ends_on_a_flat_side_it_is_rolled_off() -> None:
    """Half of a side: no point nearer to it than its skin is in the cavity, and none else is not.

    Beside it the thick skin ends in a quarter of a cylinder about its edge.
    """
    middle = BOX.bounds.mean(axis=0)
    high = float(BOX.bounds[1, 2])
    low, far = BOX.bounds[0], BOX.bounds[1]
    a, b = (low[0], low[1], high), (middle[0], low[1], high)
    c, d = (middle[0], far[1], high), (low[0], far[1], high)
    divided = trimesh.creation.box((30, 20, 16)).subdivide()
    divided.apply_translation(middle)
    solid = _solid(divided)
    patch = OpenPatch(np.array([[a, b, c], [a, c, d]]))
    made = _cavity(solid, Skin(1.0, (), (FaceSkin(patch, 3.0),)))
    # 28 x 18 x 14 less a slab 2 deep, 14 long, less what a quarter of radius 3 takes below 1 mm:
    # the integral of sqrt(9 - x^2) - 1 from 0 to sqrt(8).
    quarter = 0.5 * (9 * math.asin(math.sqrt(8) / 3) + math.sqrt(8)) - math.sqrt(8)
    wanted = 28 * 18 * 14 - 18 * (14 * 2 + quarter)
    assert made.volume == pytest.approx(wanted, rel=2e-3)


SPEC = LatticeSpec(
    "BCC", cell_size=6, strut_radius=0.6, shell=1,
    face_skins=(FaceSkin(TOP, 3.0),),
    keep_solid=(KeptFace(SIDE, 4.0), _body((6, 6, 40), (0, 0, 0))),
)  # fmt: skip


@pytest.fixture(scope="module")
def part() -> Part:
    return fill(BOX, SPEC)


@pytest.fixture(scope="module")
def domain() -> TriangleMesh:
    return fill(BOX, LatticeSpec(**{**_fields(SPEC), "output": "domain"})).result.mesh


@pytest.mark.slow
def test_the_part_its_figures_and_its_preview_agree(part: Part, domain: TriangleMesh) -> None:
    solid_room = 6 * 6 * 12
    cavity = 25 * 18 * 12 - solid_room
    assert domain.volume == pytest.approx(cavity, rel=1e-4)
    report = part.report
    assert report.watertight
    assert report.bodies == 1
    lattice = report.relative_density * cavity
    assert part.mesh.volume == pytest.approx(BOX.volume - cavity + lattice, rel=1e-3)
    depth = PartDepth(BOX, SPEC.open_faces, SPEC.face_skins, SPEC.keep_solid)
    assert depth.volume_below(1.0) == pytest.approx(cavity, rel=0.03)
    shown = preview(BOX, SPEC, depth)
    assert shown.volume == pytest.approx(part.mesh.volume, rel=0.03)
    # Every strut that is shown lies in the cavity.
    middle = 0.5 * (shown.start + shown.end)
    assert depth.below_skin(middle, 1.0).min() > -0.4


@pytest.mark.slow
def test_struts_are_told_from_walls_of_every_thickness(part: Part, domain: TriangleMesh) -> None:
    made = part.result.mesh
    kinds = kinds_of_triangles(made, BOX, SPEC)
    corners = made.vertices[made.triangles]
    off = closest_points(domain, corners.reshape(-1, 3))[1].reshape(-1, 3).max(axis=1)
    assert (off[kinds == WALL] < 0.05).all()
    assert (off[kinds == LATTICE] > 1e-6).all()


def _fields(spec: LatticeSpec) -> dict[str, object]:
    return {name: getattr(spec, name) for name in spec.__dataclass_fields__}


@pytest.mark.parametrize(
    ("skin", "said"),
    [
        (FaceSkin(TOP, 20.0), "leave nothing to fill"),
        (FaceSkin(OpenPlane((0, 0, 99), (0, 0, 1)), 2.0), "No face of the part lies at the plane"),
        (FaceSkin(SmoothFace((0, 0, 99)), 2.0), r"No face of the part lies at the point"),
    ],
)
def test_what_makes_no_sense_is_told_in_one_sentence(skin: FaceSkin, said: str) -> None:
    with pytest.raises(VolfrepError, match=said):
        fill(BOX, shell=1.0, face_skins=(skin,))


def test_a_body_that_fills_everything_and_one_that_is_open_are_refused() -> None:
    with pytest.raises(VolfrepError, match="leave nothing to fill"):
        fill(BOX, shell=1.0, keep_solid=(_body((90, 90, 90), (0, 0, 0)),))
    sheet = trimesh.creation.box((4, 4, 4))
    with pytest.raises(VolfrepError, match="is not closed"):
        KeptBody(sheet.vertices, sheet.faces[:-1])
    with pytest.raises(VolfrepError, match="need a skin"):
        LatticeSpec(shell=0.0, keep_solid=(_body((4, 4, 4), (0, 0, 0)),))


def test_a_skin_of_nothing_is_an_open_face() -> None:
    spec = LatticeSpec(shell=1.0, face_skins=(FaceSkin(TOP, 0.0),))
    assert spec == LatticeSpec(shell=1.0, open_faces=(TOP,))
