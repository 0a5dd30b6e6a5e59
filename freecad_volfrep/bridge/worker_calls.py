# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shapes that OpenCASCADE makes in a FreeCAD of its own, beside the window.

OpenCASCADE neither tells how far it is nor ends when asked, so it works where it may be ended. The
functions here are given meshes, struts and packed shapes, and return packed shapes: all that goes
from one process to another.
"""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

import FreeCAD as App
import numpy as np
import Part
from numpy.typing import NDArray

from volfrep.grid.congruent_joints import Unsuitable, distinct_joints, refuse_overlaps
from volfrep.grid.strut_graph import Wireframe
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError
from volfrep.util.numbers import place_text
from volfrep.util.progress import Monitor, ProgressCallback

from .exact import exact_lattice, joint_solid, write_exact
from .faceted import faceted_solid
from .trimmed import check_volume, exact_part, faceted_shape, offset_shape, one_solid, write_shape

#: A shape as OpenCASCADE's own binary format has it: bytes.
Packed = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class ExactJob:
    """An infill that is to have exact surfaces, in its own coordinates, mm.

    Attributes:
        lattice: struts that reach into what the lattice fills.
        solid: the base as a mesh.
        domain: what the lattice fills, as a mesh; None where no wall cuts it.
        base: the base's shape; None where it has none.
        shell: thickness of the skin, mm; None where it is uneven, and its wall the mesh's.
        with_skin: whether skin and lattice are one part.
        expected: volume of the same part as a mesh, mm3; None where the two differ on purpose.
    """

    lattice: Wireframe
    solid: TriangleMesh
    domain: TriangleMesh | None
    base: Packed | None
    shell: float | None
    with_skin: bool
    expected: float | None


@dataclass(frozen=True, eq=False)
class PackedJoints:
    """Joints of a lattice, each kind once, and what is there once.

    Attributes:
        shapes: packed compound: a solid for each kind of joint, then those that are there once.
        places: of each kind, (n, 3) where it lies, mm.
        labels: of what is there once.
        volume: of all at all places, mm3.
    """

    shapes: Packed
    places: tuple[NDArray[np.float64], ...]
    labels: tuple[str, ...]
    volume: float


def pack(shape: Part.Shape) -> Packed:
    """A shape with its placement, to be sent."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "shape.bin"
        shape.exportBinary(str(path))
        return np.fromfile(path, np.uint8)


def unpack(shape: Packed) -> Part.Shape:
    """A shape that was sent."""
    result = Part.Shape()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "shape.bin"
        shape.tofile(path)
        result.importBinary(str(path))
    return result


def packed_exact(job: ExactJob, *, progress: ProgressCallback | None = None) -> Packed:
    """The infill as a solid with exact surfaces, or a compound of solids.

    Raises:
        VolfrepError: OpenCASCADE does not manage it, or makes something of another volume.
        Cancelled: the callback said so.
    """
    return pack(_exact(job, Monitor(progress)))


def write_exact_part(
    job: ExactJob,
    path: str | os.PathLike[str],
    move: tuple[float, ...],
    *,
    progress: ProgressCallback | None = None,
) -> None:
    """Write the same as STEP; `move` is the matrix that takes it to the document's coordinates."""
    shape = _exact(job, Monitor(progress))
    shape.Placement = App.Placement(App.Matrix(*move)).multiply(shape.Placement)
    write_shape(shape, path)


def write_exact_lattice(
    lattice: Wireframe, path: str | os.PathLike[str], *, progress: ProgressCallback | None = None
) -> float:
    """As `exact.write_exact`: a lattice that no wall cuts as STEP; its volume, mm3."""
    return write_exact(lattice, path, Monitor(progress))


def packed_facets(mesh: TriangleMesh) -> Packed:
    """As `faceted.faceted_solid`: a plane face for every triangle."""
    return pack(faceted_solid(mesh))


def packed_joints(
    job: ExactJob,
    whole: NDArray[np.bool_],
    cut: NDArray[np.bool_],
    *,
    progress: ProgressCallback | None = None,
) -> PackedJoints:
    """Each kind of joint once with its places, those at the wall cut by it, and the skin.

    Args:
        job: the infill.
        whole: (n,) nodes whose joints lie wholly inside the wall.
        cut: (n,) nodes whose joints it may cut.
        progress: hears how far it is, and says whether to go on.

    Raises:
        VolfrepError: a joint cannot be fused, or the wall cannot be made.
        Cancelled: the callback said so.
    """
    monitor, lattice = Monitor(progress), job.lattice
    refuse_overlaps(lattice)
    joints = distinct_joints(lattice)
    inner, outer = (None, None) if job.domain is None else _boundaries(job)
    kinds: list[tuple[Part.Shape, NDArray[np.float64]]] = []
    single: list[tuple[str, Part.Shape]] = []
    volume = 0.0
    for done, joint in enumerate(joints):
        monitor.tick(done / len(joints))
        near = joint.places[cut[joint.places]]
        inside = joint.places[whole[joint.places]]
        if not len(near) and not len(inside):
            continue
        try:
            solid = joint_solid(joint)
        except Unsuitable as error:
            place = place_text(lattice.nodes[joint.places[0]])
            raise VolfrepError(
                f"The joint near {place} {error}: make the struts thinner."
            ) from error
        if len(inside):
            kinds.append((solid, lattice.nodes[inside]))
            volume += solid.Volume * len(inside)
        for node in near.tolist():
            monitor.tick()
            piece = solid.translated(App.Vector(*lattice.nodes[node])).common(inner)
            if piece.Solids:
                single.append((f"Cut joint {len(single) + 1}", piece))
                volume += piece.Volume
    if outer is not None:
        skin = outer.cut(inner)
        single.append(("Skin", skin))
        volume += skin.Volume
    shapes = [shape for shape, _ in kinds] + [shape for _, shape in single]
    return PackedJoints(
        pack(Part.makeCompound(shapes)),
        tuple(places for _, places in kinds),
        tuple(label for label, _ in single),
        float(volume),
    )


def _exact(job: ExactJob, monitor: Monitor) -> Part.Shape:
    if job.domain is not None:
        return exact_part(job.lattice, *_boundaries(job), job.expected, monitor)
    shape = exact_lattice(job.lattice, monitor)
    if job.expected is not None:
        check_volume(shape.Volume, job.expected)
    return shape


def _boundaries(job: ExactJob) -> tuple[Part.Shape, Part.Shape | None]:
    """The inner and the outer wall as solids; None for the outer one where there is no skin.

    Raises:
        VolfrepError: OpenCASCADE's offset does not agree with the mesh's wall, and that has too
            many triangles.
    """
    assert job.domain is not None
    base = None if job.base is None else one_solid(unpack(job.base), job.solid)
    inner = None
    if base is not None and job.shell is not None:
        inner = offset_shape(base, job.shell, job.domain)
    if inner is None:
        inner = faceted_shape(job.domain)
    if not job.with_skin:
        return inner, None
    return inner, faceted_shape(job.solid) if base is None else base
