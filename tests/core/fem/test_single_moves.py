# SPDX-License-Identifier: LGPL-2.1-or-later
"""A fold and a needle in a flat side: put right one by one, and the surface stays."""

import numpy as np
import pytest

import samples
from volfrep.fem.folds import folded_facets
from volfrep.fem.single_moves import without_faults
from volfrep.mesh.brep import faceted_brep
from volfrep.mesh.remesh import edges
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.mesh.well_shaped import angles_of
from volfrep.util.progress import Monitor


def with_points(beside: float) -> TriangleMesh:
    """A box, two of whose facets have points beside the middle of their edge: below 0 beyond it."""
    box = samples.box((6.0, 5.0, 4.0))
    points, triangles = box.vertices, box.triangles.astype(np.int64)
    normal = np.cross(
        points[triangles[:, 1]] - points[triangles[:, 0]],
        points[triangles[:, 2]] - points[triangles[:, 0]],
    )
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    table = edges(triangles, len(points))
    pair = table.triangles
    flat = np.flatnonzero(np.einsum("ij,ij->i", normal[pair[:, 0]], normal[pair[:, 1]]) > 0.9)[0]
    ends, row = table.ends[flat], pair[flat, 0]
    (apex,) = set(triangles[row]) - set(ends)
    middle = points[ends].mean(axis=0)
    inward = points[apex] - middle
    fresh = middle + beside * inward / np.linalg.norm(inward)
    fan = [
        [a, b, len(points)]
        for a, b in zip(triangles[row], np.roll(triangles[row], -1), strict=True)
    ]
    divided = np.concatenate([np.delete(triangles, row, axis=0), fan])
    return TriangleMesh(np.concatenate([points, [fresh]]), divided.astype(np.int32))


def least_angle(mesh: TriangleMesh) -> float:
    return float(angles_of(mesh.vertices[mesh.triangles]).min())


@pytest.mark.parametrize("beside", [1e-3, -1e-3])
def test_a_needle_and_a_fold_go(beside):
    mesh = with_points(beside)
    assert folded_facets(mesh).any() == (beside < 0)
    assert least_angle(mesh) < 0.1
    better = without_faults(mesh, 0.01, 2.0, Monitor())
    assert not folded_facets(better).any()
    assert least_angle(better) > 2.0
    assert faceted_brep(better).bodies == 1
    assert better.volume == pytest.approx(120.0)


def test_what_is_no_fault_stays():
    """A needle is none where folds alone are asked for, and a good mesh is the same object."""
    needle, box = with_points(1e-3), samples.box()
    assert without_faults(needle, 0.01, 0.0, Monitor()) is needle
    assert without_faults(box, 0.01, 2.0, Monitor()) is box


def test_no_move_goes_farther_than_the_tolerance():
    """A sharp roof as thin as a needle: its own height is what any move would take."""
    roof = samples.box((10.0, 0.02, 0.5))
    assert least_angle(roof) < 2.5
    assert without_faults(roof, 1e-3, 2.5, Monitor()) is roof
