# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is told about a mesh: as a file holds it, with what is wrong."""

import numpy as np
import pytest

from samples import box
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate, empty_mesh
from volfrep.reports.mesh_report import mesh_report
from volfrep.util.errors import VolfrepError


def test_a_sound_mesh_is_printable() -> None:
    report = mesh_report(box(), look_for_overlaps=True)
    rows = dict(report.rows())
    assert report.printable
    assert (rows["closed"], rows["manifold"], rows["genus"]) == ("yes", "yes", "0")
    assert rows["volume"] == "24,000.000 mm3"
    assert rows["area"] == "5,200.000 mm2"
    assert report.shortest_edge == pytest.approx(20.0)
    assert report.step == np.spacing(np.float32(40.0))
    assert report.overlap == 0.0


def test_a_hole_is_told() -> None:
    mesh = box()
    report = mesh_report(TriangleMesh(mesh.vertices, mesh.triangles[1:]), look_for_overlaps=True)
    rows = dict(report.rows())
    assert not report.printable
    assert rows["closed"] == "no (3 open edges)"
    assert "genus" not in rows
    assert report.overlap is None, "lines mean nothing there"


def test_bodies_that_run_through_each_other_are_found_by_lines() -> None:
    report = mesh_report(
        concatenate(box((10, 10, 10)), box((10, 10, 10), (3, 3, 3))), look_for_overlaps=True
    )
    assert report.closed
    assert report.defects == []
    assert report.overlap == pytest.approx(343, rel=0.05)
    assert not report.printable


def test_what_single_precision_loses_is_found() -> None:
    mesh = box((1, 1, 1))
    far = TriangleMesh(mesh.vertices * [1.0, 1.0, 1e-4] + 20_000.0, mesh.triangles)
    report = mesh_report(far)
    assert report.quality.degenerate_triangles > 0
    assert not report.printable


def test_nothing_is_refused() -> None:
    with pytest.raises(VolfrepError, match="the mesh has no triangle"):
        mesh_report(empty_mesh())
