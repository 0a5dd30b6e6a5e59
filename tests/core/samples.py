# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts for the tests, modelled from their own equations, each with its exact inside test."""

from __future__ import annotations

import manifold3d
import numpy as np
import trimesh

from volfrep.design.cells import make_cell
from volfrep.io.solid import check_solid
from volfrep.mesh.triangle_mesh import TriangleMesh

#: A cell without any symmetry.
SKEW = make_cell(
    "skew",
    [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [0.3, 0.6, 0.45]],
    [[0, 5], [5, 4], [5, 1], [0, 3], [2, 5], [1, 4]],
)
#: Of the walls of `grazed_groove`.
GRAZED_SLOPE = np.tan(np.radians(30.0))


def _mesh(solid: manifold3d.Manifold) -> TriangleMesh:
    data = solid.to_mesh64()
    return TriangleMesh(
        np.array(data.vert_properties[:, :3], np.float64), np.array(data.tri_verts, np.int32)
    )


def box(size=(40.0, 30.0, 20.0), corner=(0.0, 0.0, 0.0)) -> TriangleMesh:
    return _mesh(manifold3d.Manifold.cube(size).translate(corner))


def grazed_groove(left: float) -> TriangleMesh:
    """A block with a groove of 60 degrees inside, and a bar across whose edge, along y, leaves so
    many mm of the groove's corner, along z."""
    block = manifold3d.Manifold.cube((6.0, 6.0, 10.0)).translate((-2.0, -3.0, -5.0))
    end = 3.0 * GRAZED_SLOPE
    groove = [(x, y, z) for x, y in ((0.0, 0.0), (3.0, end), (3.0, -end)) for z in (-4.0, 4.0)]
    bar = [(x, y, z) for x, z in ((left, 0.0), (1.0, -1.0), (1.0, 1.0)) for y in (-2.0, 2.0)]
    hull = manifold3d.Manifold.hull_points
    return _mesh(block - hull(groove) + hull(bar))


def solid_block(x, y, z):
    """A box at the origin, as 12 triangles that are proved."""
    shape = trimesh.creation.box((x, y, z))
    shape.apply_translation((x / 2, y / 2, z / 2))
    return check_solid(TriangleMesh(shape.vertices, shape.faces.astype(np.int32)), "box")


def sphere(radius=20.0, subdivisions=4) -> TriangleMesh:
    ball = trimesh.creation.icosphere(subdivisions, radius)
    return TriangleMesh(np.array(ball.vertices, np.float64), np.array(ball.faces, np.int32))


#: Centres of the plate's through-holes, and their radius.
HOLES = ((15.0, 15.0), (45.0, 15.0), (30.0, 30.0))
HOLE_RADIUS = 5.0


def plate(sides=256) -> TriangleMesh:
    """A plate of 60 x 40 x 12 with three through-holes."""
    hole = manifold3d.Manifold.cylinder(20.0, HOLE_RADIUS, HOLE_RADIUS, sides)
    solid = manifold3d.Manifold.cube((60.0, 40.0, 12.0))
    for x, y in HOLES:
        solid -= hole.translate((x, y, -4.0))
    return _mesh(solid)


def inside_plate(points, margin=0.02):
    """Inside by more than the margin (the holes are polygons, not circles)."""
    inside = ((points > margin) & (points < np.array([60.0, 40.0, 12.0]) - margin)).all(axis=1)
    for centre in HOLES:
        inside &= np.linalg.norm(points[:, :2] - centre, axis=1) > HOLE_RADIUS + margin
    return inside


def bracket(turn=0.0) -> TriangleMesh:
    """An L of two arms 50 long, 10 thick, 30 wide, turned about the x axis by some degrees."""
    return _mesh(_bracket().rotate((turn, 0.0, 0.0)))


def _bracket() -> manifold3d.Manifold:
    outline = [(0.0, 0.0), (50.0, 0.0), (50.0, 10.0), (10.0, 10.0), (10.0, 50.0), (0.0, 50.0)]
    return manifold3d.CrossSection([np.array(outline)]).extrude(30.0)


def inside_bracket(points, turn=0.0):
    angle = np.deg2rad(-turn)
    x, y, z = points.T
    y, z = np.cos(angle) * y - np.sin(angle) * z, np.sin(angle) * y + np.cos(angle) * z
    arms = ((x < 50.0) & (y < 10.0)) | ((x < 10.0) & (y < 50.0))
    return arms & (x > 0.0) & (y > 0.0) & (z > 0.0) & (z < 30.0)


def naca2412(chord=1000.0, span=1000.0, points=200) -> TriangleMesh:
    """The NACA 2412 wing: chord along x, thickness along y, span along z."""
    share = (1.0 - np.cos(np.linspace(0.0, np.pi, points))) / 2.0
    m, p, t = 0.02, 0.4, 0.12
    half = 5.0 * t * (
        0.2969 * np.sqrt(share) - 0.1260 * share - 0.3516 * share**2
        + 0.2843 * share**3 - 0.1015 * share**4
    )  # fmt: skip
    front = share < p
    camber = np.where(
        front,
        m / p**2 * (2 * p * share - share**2),
        m / (1 - p) ** 2 * (1 - 2 * p + 2 * p * share - share**2),
    )
    slope = np.where(front, 2 * m / p**2 * (p - share), 2 * m / (1 - p) ** 2 * (p - share))
    angle = np.arctan(slope)
    upper = np.stack([share - half * np.sin(angle), camber + half * np.cos(angle)], axis=1)
    lower = np.stack([share + half * np.sin(angle), camber - half * np.cos(angle)], axis=1)
    outline = chord * np.concatenate([upper[::-1], lower[1:]])
    return _mesh(
        manifold3d.CrossSection([outline[::-1]], manifold3d.FillRule.NonZero).extrude(span)
    )


def ring() -> TriangleMesh:
    """A tube 30 long, 20 across outside and 12 inside, of 24 flat sides."""
    tube = manifold3d.Manifold.cylinder(30.0, 10.0, 10.0, 24)
    return _mesh(tube - manifold3d.Manifold.cylinder(40.0, 6.0, 6.0, 24).translate((0, 0, -5)))


def knot() -> TriangleMesh:
    """A square bar, 3 thick, bent in a circle of radius 20 by a turn and a bit: it meets itself."""
    bar = manifold3d.Manifold.cube((140.0, 3.0, 3.0)).refine_to_length(2.0)

    def bend(points):
        angle = points[:, 0] / 20.0
        radius, height = 20.0 - points[:, 1], points[:, 2] + 0.15 * angle
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1)

    return _mesh(bar.warp_batch(bend))


def housing(sides=24) -> TriangleMesh:
    """A rounded box, open below, with walls of 11, tilted ribs and a conical boss with a hole."""

    def rounded(x, y, z, radius):
        ball = manifold3d.Manifold.sphere(radius, sides)
        middles = np.stack(np.meshgrid(*([-1, 1],) * 3), axis=-1).reshape(-1, 3) * (
            np.array([x, y, z]) / 2 - radius
        )
        return manifold3d.Manifold.batch_hull([ball.translate(m.tolist()) for m in middles])

    outer = rounded(90, 70, 60, 25)
    solid = outer - rounded(68, 48, 38, 14)
    solid -= manifold3d.Manifold.cube((100, 100, 40)).translate((-50, -50, -50))
    window = manifold3d.Manifold.cylinder(40, 12, 12, sides, True).rotate((0, 90, 0))
    rib = manifold3d.Manifold.cube((11, 60, 34), True) - window.translate((0, 0, -4))
    for x in (-14.0, 9.0):
        solid += rib.rotate((0, 0, x / 3)).translate((x, 0, 10))
    boss = manifold3d.Manifold.cylinder(40, 11.5, 14.5, sides)
    boss -= manifold3d.Manifold.cylinder(100, 2.5, 2.5, sides)
    return _mesh((solid + boss.translate((26, 6, -10))) ^ outer)


def sheet(size=(80.0, 60.0, 3.0), hole=4.0, turn=(10.0, 20.0, 30.0)) -> TriangleMesh:
    """A turned sheet with a hole in its middle and a small one off it."""
    solid = manifold3d.Manifold.cube(size)
    for x, y, radius in ((size[0] / 2, size[1] / 2, hole), (15.3, 21.7, 0.6)):
        solid -= manifold3d.Manifold.cylinder(3 * size[2], radius, radius, 64).translate(
            (x, y, -size[2])
        )
    return _mesh(solid.rotate(turn))
