# SPDX-License-Identifier: LGPL-2.1-or-later
"""A homogenised part as a CalculiX deck: bricks, orthotropic or anisotropic materials, loads.

Bricks that are filled alike share a material, their mean, to `STEPS` steps of what fills them and
`FINE` ones of the lattice's stiffness; of skin and lattice in one brick it is the mean of both by
what they fill.
CalculiX bends its C3D8I as it should, one brick across or more.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence

import numpy as np

from ..fem.deck import node_block
from ..mechanics.elements import solid_stiffness
from ..util.files import replacing
from ..util.types import Floats
from ..voxels.loaded import VoxelCase
from .bricks import constants
from .cell_law import turned
from .model import ContinuumModel

#: Shares of a brick are told apart in so many steps; the lattice's constants by so much, those
#: beside the diagonal over what is on it.
STEPS, FINE = 25, 0.02
#: What is coupled less than this share of the largest is not: then the material is orthotropic.
_NOTHING = 1e-6
#: CalculiX's corners of a brick, of ours with z fastest.
_CORNERS = [0, 4, 6, 2, 1, 5, 7, 3]
#: Ours in CalculiX's order of axes: xx, yy, zz, xy, xz, yz.
_ORDER = [0, 1, 2, 5, 4, 3]
#: Its constants, row by row of the lower triangle.
_LOWER = [(i, j) for i in range(6) for j in range(i + 1)]
_ORTHO = [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (3, 3), (4, 4), (5, 5)]


def write_deck(
    path: str | os.PathLike[str], model: ContinuumModel, cases: Sequence[VoxelCase]
) -> None:
    """Write a homogenised part, a step for each load case.

    The supports of all steps are the first case's; of others with their own a comment says so.

    Raises:
        VolfrepError: it cannot be written.
    """
    with replacing(path) as file:
        for part in _parts(model, cases):
            file.write(part)


def _parts(model: ContinuumModel, cases: Sequence[VoxelCase]) -> Iterator[bytes]:
    yield b"** A filled part, homogenised. Units: mm, N, MPa, t.\n"
    yield from node_block(model.nodes)
    count = len(model.elements.nodes)
    own, hard = model.shares.lattice.mean(axis=1), model.shares.solid.mean(axis=1)
    frames = np.broadcast_to(model.frames, (count, 3, 3))
    lattice = turned(model.lattice, model.frames.swapaxes(1, 2))
    size = np.sqrt(np.maximum(np.einsum("kii->ki", lattice), 1e-30))
    beside = constants(lattice / (size[:, :, None] * size[:, None]))
    lattice = np.broadcast_to(lattice, (count, 6, 6))
    density = np.broadcast_to(model.density, count)
    stiff = np.broadcast_to(np.column_stack([2.0 * np.log(size), beside]), (count, 27))
    key = np.column_stack(
        [np.round(own * STEPS), np.round(hard * STEPS), np.round(stiff / FINE),
         np.round(frames.reshape(-1, 9) / FINE)]
    )  # fmt: skip
    _, first, group = np.unique(key, axis=0, return_index=True, return_inverse=True)
    group = group.ravel()
    order = np.argsort(group, kind="stable")
    solid = solid_stiffness(model.material.young, model.material.poisson)
    corners = model.elements.nodes[:, _CORNERS] + 1
    ends = np.cumsum(np.bincount(group))[:-1]
    for k, rows in enumerate(np.split(order, ends)):
        filled, hard_k = own[rows], float(hard[rows].mean())
        frame = frames[first[k]]
        local = np.einsum("k,kab->ab", filled, lattice[rows]) / len(rows)
        yield f"*ELEMENT,TYPE=C3D8I,ELSET=E{k}\n".encode()
        yield "".join(
            f"{e + 1}," + ",".join(map(str, c)) + "\n"
            for e, c in zip(rows.tolist(), corners[rows].tolist(), strict=True)
        ).encode()
        yield _material(k, local + hard_k * solid, frame)
        weight = model.material.density * 1e-9 * (hard_k + float((filled * density[rows]).mean()))
        yield f"*DENSITY\n{weight:.6g}\n".encode()
        yield f"*SOLID SECTION,ELSET=E{k},MATERIAL=M{k},ORIENTATION=O{k}\n".encode()
    yield b"*BOUNDARY\n"
    for node, axis in np.argwhere(cases[0].fixed):
        yield f"{node + 1},{axis + 1},{axis + 1}\n".encode()
    for case in cases:
        same = np.array_equal(case.fixed, cases[0].fixed)
        apart = "" if same else ": its own supports are left out"
        yield f"** Load case {case.name}{apart}\n".encode()
        yield b"*STEP\n*STATIC\n"
        if case.prescribed.any() and same:
            yield b"*BOUNDARY,OP=MOD\n"
            for node, axis in np.argwhere(case.fixed):
                value = case.prescribed[node, axis]
                yield f"{node + 1},{axis + 1},{axis + 1},{value:.9g}\n".encode()
        yield b"*CLOAD,OP=NEW\n"
        for node, axis in np.argwhere(case.loads != 0.0):
            yield f"{node + 1},{axis + 1},{case.loads[node, axis]:.9g}\n".encode()
        yield b"*NODE FILE\nU\n*EL FILE\nS\n*NODE PRINT,NSET=NALL\nU\n*END STEP\n"


def _material(number: int, tensor: Floats, frame: Floats) -> bytes:
    """A material in the axes of its orientation."""
    mixed = tensor[np.ix_(_ORDER, _ORDER)]
    rest = mixed.copy()
    for i, j in _ORTHO:
        rest[i, j] = rest[j, i] = 0.0
    ortho = np.abs(rest).max() < _NOTHING * np.abs(mixed).max()
    kind, pairs = ("ORTHO", _ORTHO) if ortho else ("ANISO", _LOWER)
    values = [f"{mixed[i, j]:.9g}" for i, j in pairs]
    lines = [",".join(values[k : k + 8]) for k in range(0, len(values), 8)]
    axes = ",".join(f"{value:.9g}" for value in (*frame[:, 0], *frame[:, 1]))
    return (
        f"*ORIENTATION,NAME=O{number}\n{axes}\n*MATERIAL,NAME=M{number}\n"
        f"*ELASTIC,TYPE={kind}\n" + "\n".join(lines) + "\n"
    ).encode()
