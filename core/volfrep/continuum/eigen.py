# SPDX-License-Identifier: LGPL-2.1-or-later
"""Natural frequencies of a homogenised part, and the loads at which it buckles as a whole.

Both are the lowest of a pair of symmetric matrices, found by blocks of conjugate gradients (A. V.
Knyazev, SIAM J. Sci. Comput. 23, 2001) that the multigrid of the statics preconditions. Mass is
lumped at the nodes, part by part of the bricks; stress that buckles is that of the bricks' parts.
What is shorter than a brick, a dimple of the skin or a strut, buckles unseen.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import csr_matrix

from ..loads.load_cases import Mass
from ..mechanics.elements import CORNERS, gradients, part_centres, solid_stiffness
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Floats
from ..voxels.multigrid import Multigrid
from .bricks import AT_ONCE
from .model import ContinuumModel, ContinuumState, multigrid_of

#: More vectors than are asked for, so that the last of these settle too.
GUARDS = 4
#: What is left of the error of frequencies' squares, of load factors, relative; the most steps.
SETTLED, MOST_STEPS = (1e-5, 1e-3), 120
#: After so many steps a part that is softened by its loads this much less than it is stiffened, or
#: by other modes, counts as one that they do not buckle.
PATIENCE, NEGLIGIBLE = 12, 1e-3
#: Directions that are nearly in the span of others are left out.
_ALIKE = 1e-12

Apply = Callable[[Floats], Floats]


def lumped_mass(model: ContinuumModel, masses: Sequence[Mass] = ()) -> Floats:
    """(n,) t at the nodes, of lattice, skin and attached bodies.

    Raises:
        VolfrepError: nothing of the part lies where a body is attached.
    """
    centres = part_centres()[:, None]
    near = np.where(CORNERS[None] == 1, centres, 1.0 - centres).prod(axis=2)  # (parts, 8)
    own = np.broadcast_to(model.density, len(model.elements.nodes))
    filled = model.shares.lattice * own[:, None]
    size = float(np.prod(model.bricks.edge)) / len(near) * model.material.density * 1e-9
    filled = filled + model.shares.solid
    # Struts in free faces are counted with their bricks only.
    more = model.loaded.shares - filled.mean(axis=1)
    each = (filled @ near + more[:, None] * (len(near) / 8.0)) * size
    corners = model.elements.nodes.ravel()
    result = np.asarray(np.bincount(corners, each.ravel(), len(model.nodes)), float)
    for one in masses:
        try:
            result += 1e-6 * one.mass * model.loaded.weights_of(one.region)
        except VolfrepError as error:
            raise VolfrepError(f"Mass '{one.name}': {error}") from error
    return result


def frequencies(
    model: ContinuumModel,
    like: ContinuumState,
    count: int,
    masses: Sequence[Mass] = (),
    monitor: Monitor | None = None,
) -> tuple[Floats, Floats]:
    """The lowest natural frequencies, with the supports of a case that was solved.

    Returns:
        (count,) Hz, and (n, 3, count) modes, the largest displacement of each 1.

    Raises:
        VolfrepError: it does not converge, or a body is attached to nothing.
        Cancelled: when the monitor says so.
    """
    solver = multigrid_of(model, ~like.case.fixed, monitor)
    mass = lumped_mass(model, masses)[:, None] * solver.fine.free
    values, modes, _ = _lowest(
        solver,
        solver.fine,
        lambda displacements: mass * displacements,
        count,
        1,
        "natural frequencies",
    )
    return np.sqrt(np.maximum(values, 0.0)) / (2.0 * np.pi), modes


def buckling_factors(
    model: ContinuumModel, state: ContinuumState, count: int, monitor: Monitor | None = None
) -> tuple[Floats, Floats]:
    """How many times a case's loads may be before the part buckles as a whole.

    Returns:
        (count,) rising load factors, inf where nothing is pressed, and (n, 3, count) modes, the
        largest displacement of each 1.

    Raises:
        VolfrepError: it does not converge.
        Cancelled: when the monitor says so.
    """
    solver = multigrid_of(model, ~state.case.fixed, monitor)
    free = solver.fine.free
    geometric = geometric_stiffness(model, state.strained)
    values, modes, largest = _lowest(
        solver,
        lambda displacements: (geometric @ displacements) * free,
        solver.fine,
        count,
        2,
        "buckling loads",
    )
    pressed = values < -NEGLIGIBLE * largest
    return np.where(pressed, -1.0 / np.where(pressed, values, 1.0), np.inf), modes


def geometric_stiffness(model: ContinuumModel, own: Floats) -> Any:
    """(n, n) N/mm, sparse, what stress adds to the stiffness of each direction.

    Args:
        model: the part.
        own: (e, 24) mm, displacements that strain each brick.
    """
    centres = part_centres()
    slopes = gradients(centres) / model.bricks.edge
    pairs = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
    weight = float(np.prod(model.bricks.edge)) / len(centres)
    table = np.empty((len(centres), 6, 64))
    for c, (i, j) in enumerate(pairs):
        one = np.einsum("pa,pb->pab", slopes[:, :, i], slopes[:, :, j])
        whole = one if i == j else one + one.swapaxes(1, 2)
        table[:, c] = whole.reshape(-1, 64) * weight
    strains = model.bricks.strains(centres).reshape(-1, 24)
    solid = solid_stiffness(model.material.young, model.material.poisson)
    nodes = model.elements.nodes
    count = len(nodes)
    lattice = np.broadcast_to(model.lattice, (count, 6, 6))
    blocks = np.empty((count, 64))
    for rows in np.array_split(np.arange(count), count // AT_ONCE + 1):
        strain = (own[rows] @ strains.T).reshape(len(rows), -1, 6)
        stress = model.shares.lattice[rows][:, :, None] * (strain @ lattice[rows])
        stress += model.shares.solid[rows][:, :, None] * (strain @ solid)
        blocks[rows] = stress.reshape(len(rows), -1) @ table.reshape(-1, 64)
    places = (np.repeat(nodes, 8, axis=1).ravel(), np.tile(nodes, (1, 8)).ravel())
    return csr_matrix((blocks.ravel(), places), (len(model.nodes),) * 2)


def _lowest(
    solver: Multigrid, one: Apply, two: Apply, count: int, power: int, what: str
) -> tuple[Floats, Floats, float]:
    """The lowest values of x'Ax / x'Bx, (n, 3, count) their vectors, and the largest size met.

    Args:
        solver: whose cycle is near to the inverse of the stiffness.
        one: A.
        two: B, positive on what is free.
        count: how many.
        power: 1 where A is the stiffness, 2 where B is: of values, in which their error is told.
        what: is looked for, for the message.
    """
    free = solver.fine.free
    shape, size = free.shape, free.size
    wide = min(count + GUARDS, int(free.sum()) // 3)
    random = np.random.default_rng(1)

    def each(apply: Apply, block: Floats) -> Floats:
        return np.stack([apply(x.reshape(shape)).ravel() for x in block.T], axis=1)

    # Long waves first: what the stiffness makes of random forces.
    found = each(solver.precondition, random.standard_normal((size, wide)) * free.reshape(-1, 1))
    by_one, by_two = each(one, found), each(two, found)
    last = [np.zeros((size, 0))] * 3
    values, largest = np.zeros(wide), 0.0
    for step in range(MOST_STEPS):
        solver.monitor.tick()
        if step:
            left = by_one - by_two * values
            ahead = each(solver.precondition, left)
            ahead -= found @ (by_two.T @ ahead)
            # How far values may be off, by the energy of what is left.
            off = np.abs(np.einsum("ik,ik->k", left, ahead))[:count]
            small = values[:count] > -NEGLIGIBLE * largest
            settled = off <= SETTLED[power - 1] * np.abs(values[:count]) ** power
            if (settled | (small & (power == 2) & (step >= PATIENCE))).all():
                break
            span = [
                np.concatenate(parts, axis=1)
                for parts in zip(
                    (found, by_one, by_two),
                    (ahead, each(one, ahead), each(two, ahead)),
                    last,
                    strict=True,
                )
            ]
        else:
            span = [found, by_one, by_two]
        length = np.sqrt(np.einsum("ik,ik->k", span[0], span[2]))
        span = [each_one / np.maximum(length, 1e-300) for each_one in span]
        sizes, ways = np.linalg.eigh(span[0].T @ span[2])
        kept = sizes > _ALIKE * sizes[-1]
        ways = ways[:, kept] / np.sqrt(sizes[kept])
        inner = ways.T @ (span[0].T @ span[1]) @ ways
        values, turned = eigh(0.5 * (inner + inner.T))
        largest = max(largest, float(np.abs(values).max()))
        values, taken = values[:wide], ways @ turned[:, :wide]
        apart = taken.copy()
        apart[:wide] = 0.0
        last = [each_one @ apart for each_one in span]
        found, by_one, by_two = (each_one @ taken for each_one in span)
    else:
        raise VolfrepError(
            f"The {what} did not settle in {MOST_STEPS} steps: something of the part hangs on next "
            "to nothing; hold more of it, or ask for fewer."
        )
    modes = found[:, :count].reshape(*shape, -1)
    return values[:count], modes / np.linalg.norm(modes, axis=1).max(axis=0), largest
