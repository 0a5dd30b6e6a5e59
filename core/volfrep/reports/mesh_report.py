# SPDX-License-Identifier: LGPL-2.1-or-later
"""Everything that a reader of a mesh file will see of a mesh, as rows for people."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..io.repair.overlaps import CLEAN
from ..io.write.stl import as_read
from ..mesh.quality import Quality, ShapeStatistics, measure, shape_statistics
from ..mesh.topology import pinched_vertices
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.piercing import piercing_pairs
from ..spatial.winding import windings
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from ..util.types import Floats


@dataclass(frozen=True, eq=False)
class MeshReport:
    """A mesh as it will be read from a file of single precision.

    Attributes:
        quality: its topology, volume and size.
        pinched: vertices where surfaces touch.
        shapes: of its triangles.
        shortest_edge: mm.
        step: of single precision where the mesh is farthest from the origin, mm.
        overlap: mm3 that lines through the mesh find enclosed more than once or the wrong way
            round; None where that was not looked for, or the mesh is not closed.
    """

    quality: Quality
    pinched: int
    shapes: ShapeStatistics
    shortest_edge: float
    step: float
    overlap: float | None

    @property
    def defects(self) -> list[str]:
        """What is wrong with its edges, triangles and vertices, each with how often."""
        q = self.quality
        return [
            f"{count:,} {what}"
            for count, what in (
                (q.overused_edges, "edges of more than two triangles"),
                (q.misoriented_edges, "edges between triangles of opposite orientation"),
                (q.degenerate_triangles, "degenerate triangles"),
                (self.pinched, "vertices where surfaces touch"),
            )
            if count
        ]

    @property
    def closed(self) -> bool:
        """Whether it has no open edge."""
        return self.quality.open_edges == 0

    @property
    def printable(self) -> bool:
        """Whether it is closed and without a defect: what every slicer reads alike."""
        return self.closed and not self.defects and not self.overlaps

    @property
    def overlaps(self) -> bool:
        """Whether lines have found more that is not enclosed once than rounding explains."""
        return self.overlap is not None and self.overlap > CLEAN * abs(self.quality.volume)

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        q = self.quality
        open_edges = "" if self.closed else f" ({q.open_edges:,} open edges)"
        listed = f" ({', '.join(self.defects)})" if self.defects else ""
        low, high = q.bounds
        return [
            ("triangles", f"{q.triangles:,}"),
            ("vertices", f"{q.vertices:,}"),
            ("closed", _yes(self.closed) + open_edges),
            ("manifold", _yes(self.closed and not self.defects) + listed),
            ("bodies", f"{q.bodies:,}"),
            ("voids", f"{q.voids:,}"),
            *([("genus", str(q.genus))] if q.watertight else []),
            ("volume", f"{q.volume:,.3f} mm3"),
            ("area", f"{q.area:,.3f} mm2"),
            ("box", " x ".join(f"{side:.3f}" for side in high - low) + " mm"),
            ("from", ", ".join(f"{value:.3f}" for value in low)),
            ("smallest angle", f"{self.shapes.smallest_angle:.2f} degrees"),
        ]


def mesh_report(
    mesh: TriangleMesh, monitor: Monitor | None = None, look_for_overlaps: bool = False
) -> MeshReport:
    """Look at a mesh as it will come back from a file of single precision.

    Args:
        mesh: any mesh, closed or not, mm.
        monitor: asked for a cancel.
        look_for_overlaps: sends lines through the mesh, too.

    Raises:
        VolfrepError: it has no triangle.
        Cancelled: when the monitor says so.
    """
    if not len(mesh.triangles):
        raise VolfrepError("There is nothing to check: the mesh has no triangle.")
    monitor = monitor or Monitor()
    read = monitor.call(lambda: as_read(mesh))
    quality = measure(read, monitor)
    overlap = None
    if look_for_overlaps and quality.watertight:
        overlap = monitor.call(lambda: windings(read).odd)
    return MeshReport(
        quality,
        monitor.call(lambda: pinched_vertices(read)),
        monitor.call(lambda: shape_statistics(read)),
        monitor.call(lambda: _shortest_edge(read)),
        float(np.spacing(np.float32(np.abs(quality.bounds).max()))),
        overlap,
    )


def checked_mesh(
    mesh: TriangleMesh, *, progress: ProgressCallback | None = None
) -> tuple[MeshReport, Floats]:
    """The report of a mesh, and (k, 3) places where two of its triangles run through each other.

    A place is the middle of what the boxes of the two have in common, mm.

    FreeCAD's own search for these opens a box when Escape is pressed, works in single precision
    with a tolerance, so that it names needles which lie a thousandth of a millimetre apart, and
    gives a list of None where its second look does not find all of what its first one did.

    Args:
        mesh: any mesh, mm.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: it has no triangle.
        Cancelled: the callback said so.
    """
    monitor = Monitor(progress)
    with monitor.stage("check", 0.0, 0.5):
        report = mesh_report(mesh, monitor, look_for_overlaps=True)
    with monitor.stage("crossings", 0.5, 1.0):
        read = as_read(mesh)
        pairs = piercing_pairs(read, monitor)
    corners = read.vertices[read.triangles[np.unique(np.sort(pairs, axis=1), axis=0)]]
    low, high = corners.min(axis=2).max(axis=1), corners.max(axis=2).min(axis=1)
    return report, 0.5 * (low + high)


def _shortest_edge(mesh: TriangleMesh) -> float:
    a, b, c = mesh.corners()
    squares = [((q - p) ** 2).sum(axis=1).min() for p, q in ((a, b), (b, c), (c, a))]
    return float(np.sqrt(min(squares)))


def _yes(value: bool) -> str:
    return "yes" if value else "no"
