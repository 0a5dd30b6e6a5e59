# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams that turn as far as they like, buckle and yield: corotational, with fibres.

Each element moves with its chord, in which its strains are small (J.-M. Battini, Co-rotational beam
elements in instability problems, KTH Stockholm, 2002). Its section is of fibres that are elastic
and plastic along the beam; shear and torsion stay elastic. Curvature is linear along an element and
bends less by what shear takes (Timoshenko).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse
from scipy.sparse.linalg import splu

from ..util.linalg import axes_across, cross_matrix
from ..util.types import Bools, Floats, Ints
from .frame import CIRCLE

#: Fibres of a circle: rings at three Gauss points of the squared radius, each of so many fibres.
_GAUSS = ((-np.sqrt(0.6), 0.0, np.sqrt(0.6)), (5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0))
AROUND = 12
#: Where along an element its section is looked at, in units of its half; both count alike.
STATIONS = np.array([-1.0, 1.0]) / np.sqrt(3.0)

#: What is out of balance, in units of the largest force, and the most corrections of a step; what
#: may be left after these, where one fold swings, is made good in the next step.
BALANCE, CORRECTIONS, LEFT = 1e-3, 10, 1e-2
#: After so many, corrections swing about a fold that yields: half of each is taken.
SWINGING = 4
#: A correction that turns a node farther, radians, leads nowhere.
MOST_TURN = 0.5


@dataclass(frozen=True, eq=False)
class State:
    """Where beams are.

    Attributes:
        places: (n, 3) of their nodes, mm.
        turns: (n, 3, 3) rotations of their nodes since they were unloaded.
        plastic: (e, 2, f) plastic strain of every fibre at both stations.
    """

    places: Floats
    turns: Floats
    plastic: Floats

    def moved(self, steps: Floats) -> State:
        """After steps (n, 6) of displacement, mm, and of turning about fixed axes, radians."""
        turns = rotations(steps[:, 3:]) @ self.turns
        return State(self.places + steps[:, :3], turns, self.plastic)


class Beams:
    """Straight round beams."""

    def __init__(
        self,
        nodes: Floats,
        elements: Ints,
        radii: Floats,
        young: Floats,
        yield_stress: ArrayLike,
        poisson: float,
        hardening: float = 0.0,
    ) -> None:
        """Beams before they are loaded.

        Args:
            nodes: (n, 3) mm.
            elements: (e, 2) rows of nodes.
            radii: (e,) mm.
            young: (e,) MPa.
            yield_stress: (e,) MPa; infinite for what does not yield.
            poisson: the ratio of all.
            hardening: slope of stress over plastic strain, MPa.
        """
        span = nodes[elements[:, 1]] - nodes[elements[:, 0]]
        self.nodes, self.elements, self.young = nodes, elements, young
        self.length = np.linalg.norm(span, axis=1)
        along = span / self.length[:, None]
        self.axes = np.stack([along, *axes_across(along)], axis=2)
        self.yield_stress = np.broadcast_to(np.asarray(yield_stress, float), young.shape)
        self.hardening = hardening
        area, shear = np.pi * radii**2, young / (2.0 * (1.0 + poisson))
        self.torsion = 0.5 * shear * area * radii**2 / self.length
        places, shares = circle_fibres()
        y, z = np.moveaxis(places * radii[:, None, None], -1, 0)
        # What a fibre takes of strain and curvatures, and of what length and section it is.
        self.levers = np.stack([np.ones_like(y), z, -y], axis=-1)
        self.volumes = (0.5 * self.length)[:, None] * (shares * area[:, None])
        slip = 3.0 * young * radii**2 / (CIRCLE.shear * shear * self.length**2)
        # What half the sum of both ends' turns makes of shear strain, and of its energy.
        self.shear = CIRCLE.shear * shear * area * self.length * (slip / (1.0 + slip)) ** 2
        self.section = self._sections(slip)

    def _sections(self, slip: Floats) -> Floats:
        """(e, 2, 3, 7) strain, and curvatures in y and z, at both stations of unit local moves."""
        found = np.zeros((len(slip), 2, 3, 7))
        bent = 3.0 * STATIONS / (1.0 + slip[:, None])
        found[:, :, 0, 0] = 1.0
        for row, (first, second) in enumerate(((2, 5), (3, 6)), 1):
            found[:, :, row, first], found[:, :, row, second] = bent - 1.0, bent + 1.0
        found /= self.length[:, None, None, None]
        return found

    def at_rest(self) -> State:
        """The beams before they are loaded."""
        count, fibres = self.volumes.shape
        return State(
            self.nodes.copy(),
            np.tile(np.eye(3), (len(self.nodes), 1, 1)),
            np.zeros((count, 2, fibres)),
        )

    def folds(self, state: State) -> Floats:
        """(e,) by how much both ends of each element are turned against each other, radians."""
        ends = state.turns[self.elements] @ self.axes[:, None]
        between = _vectors(ends[:, 0].swapaxes(1, 2) @ ends[:, 1])
        angles: Floats = np.linalg.norm(between, axis=1)
        return angles

    def respond(self, state: State) -> tuple[Floats, Floats, Floats]:
        """Forces that hold the beams where they are, if that is a small step from a state.

        Args:
            state: its plastic strains are those before the step.

        Returns:
            (e, 12) N and N mm on both ends of each element, x, y, z and moments; (e, 12, 12) how
            they change with small displacements and turns; (e, 2, f) plastic strains now.
        """
        first, second = self.elements.T
        chord = state.places[second] - state.places[first]
        length = np.linalg.norm(chord, axis=1)
        ends = state.turns[self.elements] @ self.axes[:, None]  # (e, 2, 3, 3)
        up = ends[..., 1]
        frame = np.empty((len(length), 3, 3))
        frame[:, :, 0] = chord / length[:, None]
        side = np.cross(frame[:, :, 0], up.sum(axis=1))
        frame[:, :, 2] = side / np.linalg.norm(side, axis=1, keepdims=True)
        frame[:, :, 1] = np.cross(frame[:, :, 2], frame[:, :, 0])
        back = frame.swapaxes(1, 2)
        local = np.concatenate(
            [(length - self.length)[:, None], _vectors(back[:, None] @ ends).reshape(-1, 6)], axis=1
        )
        forces, stiffness, plastic = self._local(local, state.plastic)
        _to_spins(local, forces, stiffness)
        lean = np.einsum("eij,ekj->eki", back, up)  # both ends' second axes in the frame
        return *_global(frame, length, lean, forces, stiffness), plastic

    def _local(self, local: Floats, plastic: Floats) -> tuple[Floats, Floats, Floats]:
        """Forces (e, 7), stiffness (e, 7, 7) and plastic strains, of stretch and both ends' turns.

        Args:
            local: (e, 7) stretch, mm, and turns against the chord, x, y, z of both ends.
            plastic: (e, 2, f) before.
        """
        # Strain is the logarithm of stretch, and what is squashed widens: it keeps its volume.
        ratio = self.length / (self.length + local[:, 0])
        local = np.concatenate([-(self.length * np.log(ratio))[:, None], local[:, 1:]], axis=1)
        strains = np.einsum("egsk,ek->egs", self.section, local)
        strain = np.einsum("egs,efs->egf", strains, self.levers)
        young, hardening = self.young[:, None, None], self.hardening
        stress = young * (strain - plastic)
        over = np.abs(stress - hardening * plastic) - self.yield_stress[:, None, None]
        yields = over > 0.0
        flow = np.where(yields, over, 0.0) / (young + hardening)
        flow *= np.sign(stress - hardening * plastic)
        stress -= young * flow
        slope = np.where(yields, young * hardening / (young + hardening), young)
        volumes = self.volumes[:, None]
        resultants = np.einsum("egf,efs->egs", volumes * stress, self.levers)
        tangent = np.einsum("egf,efs,eft->egst", volumes * slope, self.levers, self.levers,
                            optimize=True)  # fmt: skip
        forces = np.einsum("egsk,egs->ek", self.section, resultants)
        stiffness = np.einsum("egsk,egst,egtm->ekm", self.section, tangent, self.section,
                              optimize=True)  # fmt: skip
        forces[:, 0] *= ratio
        stiffness[:, 0] *= ratio[:, None]
        stiffness[:, :, 0] *= ratio[:, None]
        stiffness[:, 0, 0] -= forces[:, 0] * ratio / self.length
        for one, two in ((2, 5), (3, 6)):
            mean = 0.5 * (local[:, one] + local[:, two])
            for row in (one, two):
                forces[:, row] += 0.5 * self.shear * mean
                for column in (one, two):
                    stiffness[:, row, column] += 0.25 * self.shear
        twist = self.torsion * (local[:, 4] - local[:, 1])
        forces[:, 4] += twist
        forces[:, 1] -= twist
        for row, column, sign in ((1, 1, 1), (4, 4, 1), (1, 4, -1), (4, 1, -1)):
            stiffness[:, row, column] += sign * self.torsion
        return forces, stiffness, plastic + flow


class Balance:
    """Newton's method for beams some of whose moves are given."""

    def __init__(self, beams: Beams, free: Bools) -> None:
        """Beams of which (6 n,) some moves are free, x, y, z and turns of each node.

        `drag` is on displacements, N/mm, and on turns at an element's length.
        """
        self.beams, self.free = beams, free
        self.drag = 0.0
        unknown = (6 * beams.elements[:, :, None] + np.arange(6)).reshape(-1, 12)
        self.unknown = unknown.ravel()
        size = len(free)
        shape = (len(unknown), 12, 12)
        keys = np.broadcast_to(unknown[:, None, :], shape) * size + unknown[:, :, None]
        places, self.place = np.unique(keys.ravel(), return_inverse=True)
        columns, self.rows = places // size, places % size
        self.pointers = np.searchsorted(columns, np.arange(size + 1))
        # Moments count like forces at an element's length.
        weight = np.repeat([1.0, 1.0 / float(beams.length.mean())], 3)
        self.weight = np.tile(weight, size // 6)
        # Of the last balance, in which fibres that yield yielded on: what a next push meets first.
        self.stiffness: Floats | None = None

    def step(self, state: State, even: Floats) -> tuple[State, Floats, int] | None:
        """The balance after a step.

        Args:
            state: in balance.
            even: (n, 6) moves, mm and radians: what is not free makes them, and what is free is
                dragged towards them.

        Returns:
            The next state, (n, 6) forces and the number of corrections; None if none is found.
        """
        now, even = state, even.ravel()
        given = np.where(self.free, 0.0, even)
        done = np.zeros_like(even)
        drag = self.drag / self.weight**2
        for corrections in range(CORRECTIONS + 1):
            local, stiffness, plastic = self.beams.respond(now)
            forces = np.bincount(self.unknown, local.ravel(), len(even)).astype(np.float64)
            dragged = forces + drag * (done - even)
            loose = float(np.abs((self.weight * dragged)[self.free]).max())
            largest = float(np.abs(self.weight[:12] * local).max())
            enough = LEFT if corrections == CORRECTIONS else BALANCE
            if corrections and loose <= enough * largest:
                self.stiffness = stiffness
                return State(now.places, now.turns, plastic), forces.reshape(-1, 6), corrections
            if corrections == CORRECTIONS or not np.isfinite(loose):
                return None
            if not corrections and self.stiffness is not None:
                stiffness = self.stiffness
            values = np.bincount(self.place, stiffness.ravel(), len(self.rows))
            matrix = sparse.csc_matrix(
                (values, self.rows, self.pointers), shape=(len(even), len(even))
            ) + sparse.diags(drag, format="csc")
            moves = given.copy()
            moves[self.free] = splu(
                matrix[self.free][:, self.free], permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.01, options={"SymmetricMode": True},
            ).solve(-(dragged + matrix @ given)[self.free])  # fmt: skip
            if float(np.abs(moves.reshape(-1, 6)[:, 3:]).max()) > MOST_TURN:
                return None
            moves *= 0.5 if corrections > SWINGING else 1.0
            now = now.moved(moves.reshape(-1, 6))
            done += moves
            given[:] = 0.0
        return None


def circle_fibres() -> tuple[Floats, Floats]:
    """(f, 2) places in a circle of radius 1, and (f,) shares of its area."""
    squared, weights = (np.array(part) for part in _GAUSS)
    radius = np.sqrt(0.5 * (squared + 1.0))
    angle = 2.0 * np.pi * (np.arange(AROUND) + 0.5) / AROUND
    places = radius[:, None, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return places.reshape(-1, 2), np.repeat(0.5 * weights / AROUND, AROUND)


def rotations(vectors: Floats) -> Floats:
    """(n, 3, 3) rotations about (n, 3) axes by their lengths, radians (Rodrigues)."""
    angle = np.linalg.norm(vectors, axis=-1)
    axis = cross_matrix(vectors / np.maximum(angle, 1e-30)[..., None])
    sine, versine = np.sin(angle)[..., None, None], (1.0 - np.cos(angle))[..., None, None]
    turned: Floats = np.eye(3) + sine * axis + versine * (axis @ axis)
    return turned


def _vectors(turns: Floats) -> Floats:
    """(..., 3) axes by angles of rotations of less than half a turn; the reverse of `rotations`."""
    skew = 0.5 * (turns - turns.swapaxes(-1, -2))
    axis = np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], axis=-1)
    sine = np.linalg.norm(axis, axis=-1)
    cosine = 0.5 * (np.trace(turns, axis1=-2, axis2=-1) - 1.0)
    angle = np.arctan2(sine, cosine)
    longer = np.where(sine > 1e-12, angle / np.maximum(sine, 1e-12), 1.0)
    vectors: Floats = axis * longer[..., None]
    return vectors


def _to_spins(local: Floats, forces: Floats, stiffness: Floats) -> None:
    """Make what goes with turns (e, 7) what goes with small spins about the frame's axes, in place.

    Args:
        local: (e, 7) stretch and turns.
        forces: (e, 7).
        stiffness: (e, 7, 7).
    """
    turning = np.zeros_like(stiffness)
    turning[:, 0, 0] = 1.0
    extra = np.zeros_like(stiffness)
    for rows in (slice(1, 4), slice(4, 7)):
        turn, moment = local[:, rows], forces[:, rows]
        angle = np.maximum(np.linalg.norm(turn, axis=1), 1e-3)
        sine, cosine, half = np.sin(angle), np.cos(angle), np.sin(0.5 * angle) ** 2
        second = (2.0 * sine - angle * (1.0 + cosine)) / (2.0 * angle**2 * sine)
        fourth = (angle * (angle + sine) - 8.0 * half) / (4.0 * angle**4 * half)
        cross = cross_matrix(turn)
        square = cross @ cross
        unit = np.eye(3)
        inverse = unit - 0.5 * cross + second[:, None, None] * square
        outer = turn[:, :, None] * moment[:, None, :]
        product = np.einsum("ei,ei->e", turn, moment)[:, None, None] * unit
        change = second[:, None, None] * (outer - 2.0 * outer.swapaxes(1, 2) + product)
        change += fourth[:, None, None] * square @ outer.swapaxes(1, 2)
        extra[:, rows, rows] = (change - 0.5 * cross_matrix(moment)) @ inverse
        turning[:, rows, rows] = inverse
    forces[:] = np.einsum("ekj,ek->ej", turning, forces)
    stiffness[:] = turning.swapaxes(1, 2) @ stiffness @ turning + extra


def _global(
    frame: Floats, length: Floats, lean: Floats, forces: Floats, stiffness: Floats
) -> tuple[Floats, Floats]:
    """Forces (e, 12) and stiffness (e, 12, 12) in fixed axes, of those in each element's frame.

    Args:
        frame: (e, 3, 3) its axes as columns.
        length: (e,) of its chord.
        lean: (e, 2, 3) the second axes of both ends, in the frame.
        forces: (e, 7) as `Beams._local` has them.
        stiffness: (e, 7, 7) likewise.
    """
    count = len(length)
    mean = 0.5 * (lean[:, 0] + lean[:, 1])
    ratio = mean[:, 0] / mean[:, 1]
    # How the frame turns with both ends: rows about its own axes, columns in the frame.
    turn = np.zeros((count, 3, 12))
    turn[:, 0, 2], turn[:, 0, 8] = ratio / length, -ratio / length
    for place, end in ((3, 0), (9, 1)):
        turn[:, 0, place] = 0.5 * lean[:, end, 1] / mean[:, 1]
        turn[:, 0, place + 1] = -0.5 * lean[:, end, 0] / mean[:, 1]
    turn[:, 1, 2], turn[:, 1, 8] = 1.0 / length, -1.0 / length
    turn[:, 2, 1], turn[:, 2, 7] = -1.0 / length, 1.0 / length
    relative = np.zeros((count, 6, 12))
    for axis in range(3):
        relative[:, axis, 3 + axis] = relative[:, 3 + axis, 9 + axis] = 1.0
        relative[:, axis] -= turn[:, axis]
        relative[:, 3 + axis] -= turn[:, axis]
    whole = np.zeros((count, 12, 12))
    for block in range(4):
        rows = slice(3 * block, 3 * block + 3)
        whole[:, rows, rows] = frame
    moves = np.zeros((count, 7, 12))
    moves[:, 0, 0], moves[:, 0, 6] = -1.0, 1.0
    moves[:, 1:] = relative
    in_frame = np.einsum("ekj,ek->ej", moves, forces)
    # Geometric stiffness: forces turn with the frame, and the arms of moments change with it.
    geometric = np.zeros((count, 12, 12))
    across = np.diag([0.0, 1.0, 1.0])
    pulled = (forces[:, 0] / length)[:, None, None] * across
    for row, column, sign in ((0, 0, 1), (6, 6, 1), (0, 6, -1), (6, 0, -1)):
        geometric[:, row : row + 3, column : column + 3] = sign * pulled
    of_moments = np.einsum("ekj,ek->ej", relative, forces[:, 1:])
    turned = cross_matrix(of_moments.reshape(count, 4, 3)).reshape(count, 12, 3)
    geometric -= turned @ turn
    moments = forces[:, 1:4] + forces[:, 4:7]
    arm = np.zeros((count, 3))
    arm[:, 1] = (ratio * moments[:, 0] + moments[:, 1]) / length
    arm[:, 2] = moments[:, 2] / length
    stretch = moves[:, 0]
    geometric += np.einsum("eaj,ea,ek->ejk", turn, arm, stretch)
    tangent = moves.swapaxes(1, 2) @ stiffness @ moves + geometric
    fixed = whole @ tangent @ whole.swapaxes(1, 2)
    return np.einsum("eij,ej->ei", whole, in_frame), fixed
