# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parts that tests and benchmark run on: real ones where they are at hand, and modelled ones.

Real parts are read where they lie and are no part of the project: VOLFREP_PARTS names their
folder, VOLFREP_TORTURE that of the broken and odd meshes; by default they are looked for in
``shared`` beside the checkout. What needs them is skipped without them, and says so. The others
are modelled here, so that a checkout stands alone.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import manifold3d
import numpy as np
from manifold3d import CrossSection, Manifold

from volfrep.io.write.stl import write_stl
from volfrep.mesh.triangle_mesh import TriangleMesh

ROOT = Path(__file__).resolve().parent.parent


def folder(kind: str) -> Path:
    """Where the real parts (or the torture files) lie, whether there are any or not.

    Args:
        kind: ``parts`` or ``torture``. A relative path in the variable begins at the checkout.
    """
    return ROOT / (os.environ.get(f"VOLFREP_{kind.upper()}") or Path("..", "shared", kind))


PARTS, TORTURE = folder("parts"), folder("torture")
#: Why a test that needs them is skipped.
NO_PARTS = f"needs the real parts: there is no folder {PARTS} (VOLFREP_PARTS names another)"
NO_TORTURE = f"needs the torture files: no folder {TORTURE} (VOLFREP_TORTURE names another)"


def at_hand(real: str, modelled: str) -> Path:
    """A file to run on: the real part, or a modelled one in its stead where that is not there.

    Args:
        real: file name in the folder of real parts.
        modelled: name in `MODELLED`; its file is made in build/parts.
    """
    path = PARTS / real
    return path if path.is_file() else modelled_file(modelled, ROOT / "build" / "parts")


def modelled_file(name: str, into: Path) -> Path:
    """A modelled part as a binary STL file, made anew every time: the model may have changed."""
    into.mkdir(parents=True, exist_ok=True)
    path = into / f"{name}.stl"
    write_stl(MODELLED[name](), path)
    return path


def lug_bracket() -> TriangleMesh:
    """A base plate on four bolts with two lugs, in the box of the GE bracket: 178.5 x 62.5 x 108.3.

    X along the plate, Y up, Z across, as the example that the workbench models.
    """
    plate = _rounded_rectangle(178.5, 108.3, 13.0)
    for sign in (-1.0, 1.0):
        plate -= CrossSection.circle(30.0, 128).translate((sign * 103.25, 0.0))
        for side in (-1.0, 1.0):
            plate -= CrossSection.circle(5.25, 64).translate((sign * 70.0, side * 37.0))
    eye = CrossSection.circle(20.5, 128).translate((0.0, 42.0))
    foot = CrossSection([np.array([(-58.0, 0.0), (58.0, 0.0), (58.0, 8.0), (-58.0, 8.0)])])
    lug = CrossSection.batch_hull([eye, foot]) - CrossSection.circle(10.0, 96).translate((0, 42.0))
    # The plate's outline lies in XZ, which the extrusion turns upright.
    solid = Manifold.extrude(plate, 20.0).rotate((-90.0, 0.0, 0.0))
    for z in (-36.0, 13.0):
        solid += Manifold.extrude(lug, 23.0).translate((0.0, 0.0, z))
    return _mesh(solid)


def piston_rod() -> TriangleMesh:
    """Two eyes and a tapered I-section between them: 121 x 28 x 11.6, X along the rod."""
    pitch = 98.5
    ends = [
        CrossSection.circle(radius, 160).translate((x, 0.0))
        for x, radius in ((0, 14), (pitch, 8.5))
    ]
    solid = Manifold.batch_boolean(
        [Manifold.extrude(end, 11.6).translate((0, 0, -5.8)) for end in ends], manifold3d.OpType.Add
    )
    shank = CrossSection.batch_hull(
        [CrossSection.circle(r, 96).translate((x, 0.0)) for x, r in ((0, 10), (pitch, 6))]
    )
    solid += Manifold.extrude(shank, 9.6).translate((0, 0, -4.8))
    pocket = CrossSection.batch_hull(
        [CrossSection.circle(r, 64).translate((x, 0.0)) for x, r in ((24, 4.5), (81, 3.5))]
    )
    for z in (2.0, -6.0):
        solid -= Manifold.extrude(pocket, 4.0).translate((0, 0, z))
    for x, radius in ((0.0, 9.0), (pitch, 4.5)):
        solid -= Manifold.cylinder(20.0, radius, radius, 128).translate((x, 0.0, -10.0))
    oil = Manifold.cylinder(20.0, 1.0, 1.0, 48).rotate((0.0, 90.0, 0.0))
    return _mesh(solid - oil.translate((pitch, 0.0, 0.0)))


def ribbed_housing() -> TriangleMesh:
    """An open box of 90 x 60 x 32 with walls of 3, ribs of 2.4 inside, and screw bosses."""
    wall, floor = 3.0, 3.0
    solid = Manifold.extrude(_rounded_rectangle(90.0, 60.0, 8.0), 32.0)
    room = Manifold.extrude(_rounded_rectangle(90.0 - 2 * wall, 60.0 - 2 * wall, 5.0), 32.0)
    solid -= room.translate((0.0, 0.0, floor))
    ribs = [
        Manifold.cube((2.4, 58.0, 15.0), True).translate((x, 0.0, 7.5)) for x in (-26.0, 0.0, 26.0)
    ]
    ribs += [Manifold.cube((88.0, 2.4, 12.0), True).translate((0.0, y, 6.0)) for y in (-12.0, 12.0)]
    solid += Manifold.batch_boolean(ribs, manifold3d.OpType.Add)
    for x in (-37.0, 37.0):
        for y in (-22.0, 22.0):
            solid += Manifold.cylinder(26.0, 4.5, 4.0, 64).translate((x, y, 1.0))
            solid -= Manifold.cylinder(26.0, 1.25, 1.25, 32).translate((x, y, 8.0))
    # Vents that are hardly wider than the wall is thick.
    for x in np.arange(-20.0, 21.0, 5.0):
        solid -= Manifold.cube((2.0, 30.0, 10.0), True).translate((x + 2.5, 30.0, 22.0))
    return _mesh(solid)


def imported_flange() -> TriangleMesh:
    """A flanged hub as an import gives it: curved faces in many narrow facets, at float32.

    Its faces are 360 facets round, with fillets of 16 strips, and fans of slivers between holes.
    """
    bend = np.linspace(0.0, np.pi / 2.0, 17)
    inner = np.stack([24.0 - 6.0 * np.sin(bend), 12.0 + 6.0 - 6.0 * np.cos(bend)], axis=1)
    outer = np.stack([18.0 - 2.0 + 2.0 * np.cos(bend), 38.0 + 2.0 * np.sin(bend)], axis=1)
    outline = np.vstack([[(9.0, 0.0), (40.0, 0.0), (40.0, 12.0)], inner, outer, [(9.0, 40.0)]])
    solid = Manifold.revolve(CrossSection([outline]), 360)
    for angle in np.arange(0.0, 360.0, 60.0):
        hole = Manifold.cylinder(20.0, 3.25, 3.25, 180).translate((32.0, 0.0, -4.0))
        solid -= hole.rotate((0.0, 0.0, angle))
    cross = Manifold.cylinder(60.0, 3.0, 3.0, 240).rotate((0.0, 90.0, 0.0))
    solid -= cross.translate((0.0, 0.0, 29.0))
    return _mesh(solid)


def three_bodies() -> TriangleMesh:
    """Three bodies apart from each other: a ball, a tube, and a block with a void in it."""
    ball = Manifold.sphere(14.0, 96)
    tube = Manifold.cylinder(30.0, 14.0, 14.0, 96) - Manifold.cylinder(30.0, 6.0, 6.0, 64)
    block = Manifold.cube((28.0, 28.0, 28.0), True) - Manifold.sphere(4.0, 48)
    placed = [ball, tube.translate((40.0, 0.0, -15.0)), block.translate((0.0, 40.0, 0.0))]
    return _mesh(Manifold.compose(placed))


#: What the project models itself, by name.
MODELLED: dict[str, Callable[[], TriangleMesh]] = {
    "bracket": lug_bracket,
    "piston_rod": piston_rod,
    "ribbed_housing": ribbed_housing,
    "imported_flange": imported_flange,
    "three_bodies": three_bodies,
}


def _rounded_rectangle(length: float, width: float, radius: float) -> CrossSection:
    """About the origin."""
    inner = CrossSection.square((length - 2 * radius, width - 2 * radius), True)
    return inner.offset(radius, manifold3d.JoinType.Round, circular_segments=128)


def _mesh(solid: Manifold) -> TriangleMesh:
    data = solid.to_mesh64()
    return TriangleMesh(
        np.array(data.vert_properties[:, :3], np.float64), np.array(data.tri_verts, np.int32)
    )
