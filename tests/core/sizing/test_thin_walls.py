# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts whose walls are thinner than two skins: ours, CalculiX's wedges, and bricks of the mesh."""

import shutil

import numpy as np
import pytest
from manifold3d import CrossSection, Manifold

from bricks import Bricks
from volfrep import LatticeSpec
from volfrep.fem.wedge_mesh import wedge_shares
from volfrep.io.solid import check_solid
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal, size
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.mesh.booleans import as_mesh
from volfrep.sizing.analysis import Limits

FORCE = (0.0, -100.0, 0.0)
TITANIUM = find_material("Ti-6Al-4V")

needs_calculix = pytest.mark.skipif(
    shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed"
)


def arm():
    """A quarter of a ring, 12 mm thick at its ends and 3.5 mm in the middle; 12 mm deep."""
    turn = np.linspace(0.0, np.pi / 2, 49)
    half = 0.5 * (3.5 + 8.5 * np.cos(2.0 * turn) ** 2)
    way = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    outline = np.concatenate([(40 + half)[:, None] * way, ((40 - half)[:, None] * way)[::-1]])
    outline[np.abs(outline) < 1e-9] = 0.0
    body = Manifold.extrude(CrossSection([outline.tolist()]), 12.0)
    return check_solid(as_mesh(body), "arm"), 1, (0, 0.0)


def neck():
    """Two blocks of 18 x 12 x 12 mm, and a plate of 3 mm between them."""
    plate = CrossSection.square((76, 3)).translate((0, 4.5))
    blocks = [CrossSection.square((18, 12)).translate((x, 0)) for x in (0, 58)]
    body = Manifold.extrude(plate + blocks[0] + blocks[1], 12.0)
    return check_solid(as_mesh(body), "neck"), 0, (0, 76.0)


def on_plane(axis, value):
    point, normal = np.zeros((2, 3))
    point[axis], normal[axis] = value, 1.0
    return InPlane(tuple(point.tolist()), tuple(normal.tolist()))


def made(part):
    """The part with a skin of 2 mm about struts of CVC, and where its force acts."""
    solid, held, (axis, value) = part
    case = LoadCase("bend", (Support(on_plane(held, 0.0)),), (Force(on_plane(axis, value), FORCE),))
    spec = LatticeSpec("CVC", cell_size=12, strut_radius=1.2, shell=2)
    goal = Goal(thinnest=1.19, thickest=1.2)
    return size(solid, spec, LoadCases(TITANIUM, (case,)), goal, most_steps=1)


@pytest.mark.costly
@pytest.mark.slow_but("neck")
@needs_calculix
@pytest.mark.parametrize("shape", [arm, neck])
def test_wedges_of_both_sides_are_one_where_the_wall_is_thinner_than_two_skins(shape):
    """Tied apart from each other they did not turn: the neck moved 0.09 times as far, the arm 0.26.

    What bricks of the finished meshes say of both is the slow test below.
    """
    proof = made(shape()).report["calculix"]
    assert proof["largest_displacement"] == pytest.approx([1.0], abs=0.12)
    assert max(proof["displacements_off"]) < 0.12


@needs_calculix
@pytest.mark.slow
@pytest.mark.parametrize("shape", [arm, neck])
def test_ours_and_calculix_move_as_bricks_of_the_finished_mesh(shape):
    part = shape()
    solid, held, (axis, value) = part
    design = made(part)
    bricks = Bricks(Infill(solid, design.spec).part.mesh, 0.5, TITANIUM.young, TITANIUM.poisson)
    shares = bricks.spread(lambda nodes: np.abs(nodes[:, axis] - value) < 1e-3)
    moved = bricks.displacements(
        np.abs(bricks.nodes[:, held]) < 1e-3, shares[:, None] * np.array(FORCE)
    )
    most = float(np.linalg.norm(moved, axis=1).max())
    ours = float(design.sized.analysis.largest[0])
    theirs = ours * design.report["calculix"]["largest_displacement"][0]
    shares = f"ours {ours / most:.3f}, CalculiX {theirs / most:.3f}"
    print(f"\n{shape.__name__}: bricks {most:.4f} mm, {shares}")
    assert ours == pytest.approx(most, rel=0.1)
    assert theirs == pytest.approx(most, rel=0.1)


@needs_calculix
@pytest.mark.slow
def test_beams_do_not_confirm_beams_where_struts_make_the_part_solid():
    """Both solutions of the same struts agree, and bricks of the mesh move farther than either."""
    shape = Manifold.cube((96.0, 12.0, 12.0))
    solid = check_solid(as_mesh(shape), "box")
    case = LoadCase("bend", (Support(on_plane(0, 0.0)),), (Force(on_plane(0, 96.0), FORCE),))
    spec = LatticeSpec("CVC", cell_size=12, strut_radius=3.2, shell=2)
    goal = Goal(Limits(displacement=1e-3), thinnest=3.19, thickest=3.2)
    loads = LoadCases(TITANIUM, (case,))
    design = size(solid, spec, loads, goal, most_steps=1)
    proof, ours = design.report["calculix"], float(design.sized.analysis.largest[0])
    assert proof["largest_displacement"] == pytest.approx([1.0], abs=0.05)
    mesh = Infill(solid, design.spec).part.mesh
    bricks = Bricks(mesh, 1.0, TITANIUM.young, TITANIUM.poisson)
    shares = bricks.spread(lambda nodes: nodes[:, 0] > 96 - 1e-3)
    moved = bricks.displacements(bricks.nodes[:, 0] < 1e-3, shares[:, None] * np.array(FORCE))
    most = float(np.linalg.norm(moved, axis=1).max())
    print(f"\nbox: bricks {most:.5f} mm, ours {ours / most:.3f}")
    assert ours < 0.9 * most
    assert not proof["confirmed"]
    assert "of the space that they fill" in " ".join(proof["doubts"])


def test_bricks_bend_and_stretch_as_the_closed_forms_say():
    """A bar of 40 x 4 x 6 mm, two bricks thick, without lateral contraction at its clamp."""
    bar = as_mesh(Manifold.cube((40.0, 4.0, 6.0)))
    bricks = Bricks(bar, 2.0, 100_000.0, 0.0)
    assert bricks.volume == pytest.approx(960.0)
    held = bricks.nodes[:, 0] < 1e-3
    shares = bricks.spread(lambda nodes: nodes[:, 0] > 40 - 1e-3)
    pulled = bricks.displacements(held, shares[:, None] * np.array([240.0, 0, 0]))
    assert pulled[shares > 0, 0] == pytest.approx(240 * 40 / 100_000 / 24, rel=1e-4)
    bent = bricks.displacements(held, shares[:, None] * np.array([0, 10.0, 0]))
    beam = 10 * 40**3 / 3 / 100_000 / (6 * 4**3 / 12) + 1.2 * 10 * 40 / 50_000 / 24
    assert shares @ bent[:, 1] == pytest.approx(beam, rel=0.01)


def test_shares_of_a_wedge_are_those_of_its_fifteen_nodes():
    """Each is 1 at its own node and 0 at all others, together 1; quadratic fields are exact."""
    area = np.eye(3)
    sides = 0.5 * (area + np.roll(area, -1, axis=0))
    nodes = [(part, z) for z, parts in ((-1, area), (1, area)) for part in parts]
    nodes += [(part, z) for z in (-1, 1) for part in sides] + [(part, 0) for part in area]
    places = np.array([[part[1], part[2], z] for part, z in nodes])
    assert wedge_shares(places) == pytest.approx(np.eye(15))
    at = np.random.default_rng(2).uniform(-0.2, 0.8, (20, 3))
    assert wedge_shares(at).sum(axis=1) == pytest.approx(1.0)

    def bent(place):
        x, y, z = place.T
        return 1.0 + 2.0 * x - y + 0.5 * z + x * y - 3.0 * x**2 + z**2 - x * z

    assert wedge_shares(at) @ bent(places) == pytest.approx(bent(at))
