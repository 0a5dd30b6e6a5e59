# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces left open: no skin there, and struts cut flush."""

from dataclasses import replace

import numpy as np
import pytest

import samples
from exact import in_lattice
from volfrep import LatticeSpec, VolfrepError
from volfrep.design.cells import LIBRARY
from volfrep.design.openings import OpenPatch, OpenPlane, open_triangles
from volfrep.io.write.stl import as_read
from volfrep.jobs.beam_part import clipped_infill
from volfrep.jobs.pipeline import fill
from volfrep.mesh import quality
from volfrep.mesh.triangle_mesh import TriangleMesh, compact
from volfrep.shell.offset import find_cavity
from volfrep.spatial.proximity import closest_points
from volfrep.spatial.rays import inside_points
from volfrep.util.cache import StageCache
from volfrep.util.progress import Monitor

TOP = OpenPlane((5.0, 5.0, 20.0), (0.0, 0.0, 1.0))
SPEC = LatticeSpec(
    cell="Octet", cell_size=8, strut_radius=0.8, shell=2, resolution=12, open_faces=(TOP,)
)


@pytest.mark.costly
def test_the_open_box_is_filled_up_to_its_face():
    domain = fill(samples.box(), replace(SPEC, output="domain")).mesh
    # The skin is within 5 % of its thickness, and the open face is exactly where it is.
    np.testing.assert_allclose(domain.bounds, [[2, 2, 2], [38, 28, 20]], atol=0.1)
    assert domain.bounds[1, 2] == pytest.approx(20.0, abs=1e-9)
    assert domain.volume == pytest.approx(36.0 * 26.0 * 18.0, rel=0.001)


@pytest.mark.slow
def test_an_open_part_is_where_skin_or_lattice_is():
    """Monte Carlo, with the skin on five of the six sides; and the same in the open face."""
    solid = samples.box()
    result = fill(solid, replace(SPEC, resolution=None))
    report = result.report
    assert (report.bodies, report.voids) == (1, 0)
    read = quality.measure(as_read(result.mesh))
    assert read.watertight
    assert (read.bodies, read.voids, read.genus) == (1, 0, report.genus)
    low, high = solid.bounds

    def inside(points):
        skin = (points < low + 2).any(axis=1) | (points[:, :2] > high[:2] - 2).any(axis=1)
        return skin | in_lattice(points - low, LIBRARY["Octet"], 8.0, 0.8)

    points = np.random.default_rng(11).uniform(low, high, (40_000, 3))
    share = inside(points).mean()
    deviation = 24_000.0 * np.sqrt(share * (1 - share) / len(points))
    exact = 24_000.0 * share
    assert report.volume_mm3 == pytest.approx(exact, abs=0.005 * exact + 3 * deviation)

    corners = np.stack(result.mesh.corners(), axis=1)
    flush = (np.abs(corners[:, :, 2] - 20.0) < 1e-9).all(axis=1)
    a, b, c = corners[flush].swapaxes(0, 1)
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    points[:, 2] = 20.0
    share = inside(points).mean()
    deviation = 1200.0 * np.sqrt(share * (1 - share) / len(points))
    # The lattice is moved by 1.7e-4 L upwards, and facets of a strut stray by r / 35.
    assert area == pytest.approx(1200.0 * share, abs=0.02 * 1200.0 * share + 3 * deviation)


@pytest.mark.slow
def test_the_skin_keeps_its_thickness_up_to_the_open_face():
    solid = samples.plate()
    is_open = open_triangles(solid, (OpenPlane((0.0, 0.0, 12.0), (0.0, 0.0, 1.0)),))
    wall = find_cavity(solid, 2.0, Monitor(), is_open).mesh
    assert quality.measure(wall).watertight
    skin = compact(TriangleMesh(solid.vertices, solid.triangles[~is_open]))
    a, b, c = wall.corners()
    random = np.random.default_rng(5)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    pick = random.choice(len(area), 10_000, p=area / area.sum())
    weight = random.dirichlet((1.0, 1.0, 1.0), 10_000)
    points = weight[:, :1] * a[pick] + weight[:, 1:2] * b[pick] + weight[:, 2:] * c[pick]
    points = points[inside_points(solid, points, Monitor())]
    assert len(points) > 5000
    assert np.abs(closest_points(skin, points)[1] / 2.0 - 1.0).max() < 0.05
    # Nothing lies over the lower skin but what is cut away: it ends beyond the open face.
    assert wall.bounds[1, 2] == pytest.approx(13.0, abs=0.05)


@pytest.mark.slow
def test_a_plate_may_be_open_on_both_sides():
    planes = tuple(OpenPlane((0.0, 0.0, z), (0.0, 0.0, 1.0)) for z in (0.0, 12.0))
    spec = replace(SPEC, cell_size=6.0, strut_radius=0.6, open_faces=planes)
    report = fill(samples.plate(), spec).report
    assert (report.bodies, report.voids) == (1, 0)
    # The skin is the rim, and a tube round each hole.
    area = 60.0 * 40.0 - 56.0 * 36.0 + 3.0 * np.pi * (7.0**2 - 5.0**2)
    lattice = report.volume_mm3 - area * 12.0
    assert report.relative_density == pytest.approx(lattice / report.domain_volume_mm3, rel=0.02)


@pytest.mark.slow
def test_the_outputs_of_an_open_part_add_up():
    solid, cache = samples.box(), StageCache()
    part, lattice, domain = (
        fill(solid, replace(SPEC, output=o), cache=cache) for o in ("part", "lattice", "domain")
    )
    skin = solid.volume - domain.mesh.volume
    assert part.mesh.volume == pytest.approx(skin + lattice.mesh.volume, rel=1e-4)


@pytest.mark.slow
def test_struts_that_end_in_an_open_face_have_a_free_end():
    solid = samples.box()
    closed = replace(SPEC, cell="CVC", remove_dangling=True, open_faces=())
    assert fill(solid, closed).report.struts_dangling_removed == 0
    report = fill(solid, replace(closed, open_faces=(TOP,))).report
    assert report.struts_dangling_removed > 0
    assert (report.bodies, report.watertight) == (1, True)


@pytest.mark.slow
def test_beams_are_not_held_in_an_open_face():
    clipped = clipped_infill(samples.box(), replace(SPEC, origin=(0.0, 0.0, 1.0)))
    nodes, on_boundary = clipped.wireframe.nodes, clipped.on_boundary
    flush = np.abs(nodes[:, 2] - 20.0) < 1e-9
    low = np.abs(nodes[:, 2] - 2.0) < 1e-3
    assert flush.sum() > 10
    assert low.sum() > 10
    assert not on_boundary[flush].any()
    assert on_boundary[low].all()


def test_a_patch_of_facets_finds_the_face_it_was_taken_from():
    solid = samples.plate()
    normal = np.cross(*(corner - solid.corners()[0] for corner in solid.corners()[1:]))
    bore = np.abs(normal[:, 2]) < 1e-9
    middle = np.stack(solid.corners(), axis=1).mean(axis=1)
    bore &= np.linalg.norm(middle[:, :2] - samples.HOLES[0], axis=1) < 5.1
    patch = OpenPatch(np.stack(solid.corners(), axis=1)[bore])
    assert np.array_equal(open_triangles(solid, (patch,)), bore)


@pytest.mark.slow
def test_a_bore_may_be_open():
    """A curved face: the lattice shows in the bore, and the other bores keep their skin."""
    solid = samples.plate(64)
    middle = np.stack(solid.corners(), axis=1).mean(axis=1)
    bore = np.linalg.norm(middle[:, :2] - samples.HOLES[2], axis=1) < 5.01
    bore &= np.ptp(np.stack(solid.corners(), axis=1)[:, :, 2], axis=1) > 1.0
    patch = OpenPatch(np.stack(solid.corners(), axis=1)[bore])
    spec = replace(SPEC, cell_size=6.0, strut_radius=0.5, open_faces=(patch,))
    report = fill(solid, spec).report
    assert (report.bodies, report.voids) == (1, 0)
    area = 56.0 * 36.0 - 2.0 * np.pi * 7.0**2 - np.pi * 5.0**2
    assert report.domain_volume_mm3 == pytest.approx(area * 8.0, rel=0.01)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"open_faces": (OpenPlane((0, 0, 10), (0, 0, 1)),)}, "No face of the part lies in"),
        ({"open_faces": (OpenPlane((0, 0, 20), (0, 1, 1)),)}, "No face of the part lies in"),
        (
            {
                "open_faces": tuple(
                    OpenPlane(p, n)
                    for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1))
                    for p in ((0, 0, 0), (40, 30, 20))
                )
            },
            "All faces of the part are left open",
        ),
    ],
)
def test_faces_that_cannot_be_open_are_refused(changes, message):
    with pytest.raises(VolfrepError, match=message):
        fill(samples.box(), replace(SPEC, **changes))


def test_what_makes_no_sense_is_refused():
    with pytest.raises(VolfrepError, match="need a skin"):
        replace(SPEC, shell=0)
    with pytest.raises(VolfrepError, match="must not be zero"):
        OpenPlane((0, 0, 0), (0, 0, 0))
    with pytest.raises(VolfrepError, match="finite number"):
        OpenPlane((0, 0, np.nan), (0, 0, 1))
