# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams, with or without a skin of solid elements, solved by CalculiX.

A cone is steps here, beams are expanded into solid elements, and a skin is of second-order wedges.

CalculiX makes rigid knots where sections or directions change, and with Poisson's ratio a stepped
cone is too stiff: so the deck has none, and gives the shear modulus by itself with an orientation
along each strut.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..mechanics.frame import SQUARE_SECTION
from ..mechanics.materials import Material
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .beam_mesh import BeamMesh
from .calculix import run
from .deck import SQUARE, element_block, node_block, width_of_ends
from .model import Case
from .wedge_mesh import WedgeMesh

#: CalculiX sees no load factors below 1, and those far above it badly: what it is given is scaled
#: so that it finds about this one.
_FACTOR = 10.0
#: Struts whose directions differ by less share an orientation.
DIRECTION = 1e-6
#: Shear modulus of a single square element over what makes it twist and slide as the square does.
SQUARE_SHEAR = 0.5 * (SQUARE_SECTION.torsion + SQUARE_SECTION.shear)
#: How much stiffer the skin is where struts stand on it, through its whole thickness: with it
#: skinned boxes bend as their tetrahedra do.
PAD_STIFFNESS = 1.5
#: How the frame is named where CalculiX does not solve it.
_NAME = "the frame"


@dataclass(frozen=True, eq=False)
class SolidSkin:
    """Wedges, whose nodes follow those of the beams in a deck, and what hangs on them.

    Attributes:
        mesh: the wedges.
        followers: (q,) nodes of the deck that follow others.
        leaders: (q, w) nodes of the deck; what there are fewer is filled with weights of 0.
        weights: (q, w, 3, 3) of each leader's displacement.
        springs: (p, 2) nodes of the deck that are held together.
        stiffness: N/mm of every spring in every direction.
    """

    mesh: WedgeMesh
    followers: Ints
    leaders: Ints
    weights: Floats
    springs: Ints
    stiffness: float


@dataclass(frozen=True, eq=False)
class SolvedFrame:
    """What CalculiX says of a frame.

    Attributes:
        displacements: (nodes, 3, cases) of all nodes of the deck, mm.
        sections: (nodes, 3, cases) the axial force in the beams, N, and the moments about the two
            axes of their section, N mm: at nodes between equal elements of a strut.
        frequencies: (modes,) Hz.
        skin: (nodes, 6, cases) stresses at the nodes of a skin's solids, MPa: xx, yy, zz, xy, yz,
            zx; 0 elsewhere.
        factors: (cases,) how many times the loads may be before the frame buckles; nan where that
            was not asked for.
    """

    displacements: Floats
    sections: Floats
    frequencies: Floats
    factors: Floats
    skin: Floats


def solve_frame(
    model: BeamMesh,
    material: Material,
    cases: Sequence[Case],
    *,
    skin: SolidSkin | None = None,
    more_nodes: Floats | None = None,
    attached: Floats | None = None,
    modes: int = 0,
    expected: Floats | None = None,
    monitor: Monitor | None = None,
) -> SolvedFrame:
    """Solve beams by CalculiX: once for all cases of the same supports.

    Args:
        model: the beams.
        material: of the struts.
        cases: what they carry; their nodes are the beams' and those of the skin.
        skin: about them; None for none.
        more_nodes: (h, 3) nodes behind those of the skin, which only follow others, mm.
        attached: (nodes,) t, of bodies that move with the nodes; None for none.
        modes: how many frequencies, with the first case's supports.
        expected: (cases,) near which load factor each case buckles, nan where that is not asked
            for; None for nowhere.
        monitor: asked for a cancel while CalculiX runs.

    Raises:
        VolfrepError: CalculiX is not installed, or does not solve it.
        Cancelled: when the monitor says so.
    """
    parts = [model.nodes]
    parts += [] if skin is None else [skin.mesh.nodes]
    parts += [] if more_nodes is None else [more_nodes]
    nodes = np.concatenate(parts)
    displacements = np.zeros((len(nodes), 3, len(cases)))
    sections = np.zeros((len(nodes), 3, len(cases)))
    on_skin = np.zeros((len(nodes), 6, len(cases)))
    frequencies = np.zeros(0)
    factors = np.full(len(cases), np.nan)

    def deck(fixed: Bools, steps: Sequence[str]) -> Iterator[bytes]:
        yield from _beams(nodes, model, material)
        if skin is not None:
            yield from _skin(skin, model, material)
        if attached is not None:
            first = len(model.elements)
            first += 0 if skin is None else len(skin.mesh.elements) + 3 * len(skin.springs)
            yield from _masses(attached, first)
        yield _boundary(fixed).encode()
        yield from (step.encode() for step in steps)

    for group in _of_equal_supports(cases):
        fixed, with_modes = cases[group[0]].fixed, modes > 0 and 0 in group
        steps = [_static(cases[k]) for k in group]
        if with_modes:
            steps.append(f"*STEP\n*FREQUENCY\n{modes}\n*END STEP\n")
        with run(deck(fixed, steps), _NAME, monitor, steps=len(group)) as results:
            for k, (number, values) in zip(group, results.displacements, strict=False):
                displacements[number, :, k] = values
            for k, (number, values) in zip(group, results.section_forces(), strict=False):
                sections[number, :, k] = values[:, [2, 4, 5]]
                solid = number >= len(model.nodes)
                on_skin[number[solid], :, k] = values[solid]
            if with_modes:
                frequencies = results.frequencies()[:modes]
        for k in group:
            near = np.nan if expected is None else float(expected[k])
            if np.isfinite(near):
                scale = near / _FACTOR
                with run(deck(fixed, [_buckling(cases[k], scale)]), _NAME, monitor) as results:
                    found = results.load_factor()
                if found is None:
                    raise VolfrepError("CalculiX found no load at which the frame buckles.")
                factors[k] = scale * found
    return SolvedFrame(displacements, sections, frequencies, factors, on_skin)


def _of_equal_supports(cases: Sequence[Case]) -> list[list[int]]:
    """The cases in groups that one run solves."""
    groups: list[list[int]] = []
    for k, case in enumerate(cases):
        same = next((g for g in groups if np.array_equal(cases[g[0]].fixed, case.fixed)), None)
        groups.append([k]) if same is None else same.append(k)
    return groups


def _beams(nodes: Floats, model: BeamMesh, material: Material) -> Iterator[bytes]:
    """Nodes, elements and sections.

    CalculiX makes rigid knots where sections or directions change, which hinder a material's
    lateral contraction: with Poisson's ratio, ten steps of a cone are 6 % too stiff. So there is
    none here, and the modulus of shear is given by itself, which takes an orientation along the
    strut. A square of one element has the torsion of its polar moment and no shear coefficient:
    both go into that modulus, too.
    """
    yield from node_block(nodes)
    ends = model.nodes[model.elements]
    along = ends[:, 1] - ends[:, 0]
    along /= np.linalg.norm(along, axis=1)[:, None]
    names = np.round(along / DIRECTION).astype(np.int64)
    key = np.column_stack([names, model.section, model.is_joint])
    _, first, group = np.unique(key, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(group.ravel(), kind="stable")
    for k, chosen in enumerate(np.split(order, np.cumsum(np.bincount(group.ravel()))[:-1])):
        yield from element_block("B31", f"E{k}", chosen, model.elements[chosen])
    yield b"*ELSET,ELSET=EALL\n"
    yield "".join(f"E{k}\n" for k in range(len(first))).encode()
    section_area = SQUARE**2 / np.pi
    shear = material.young / (2.0 * (1.0 + material.poisson)) * SQUARE_SHEAR
    for k, row in enumerate(first.tolist()):
        axis = along[row]
        aside = np.cross(axis, np.eye(3)[np.argmin(np.abs(names[row]))])
        aside /= np.linalg.norm(aside)
        fitted, side = model.ends[model.section[row]], SQUARE * model.radii[model.section[row]]
        factor, wide = 1.0, 1.0
        if model.is_joint[row]:
            factor, wide = fitted.modulus, width_of_ends(fitted)
        young, weight = material.young * factor, material.density * 1e-9 / section_area / wide**2
        x, y = (",".join(f"{value:.12g}" for value in way) for way in (axis, aside))
        yield (
            f"*ORIENTATION,NAME=O{k}\n{x},{y}\n*MATERIAL,NAME=M{k}\n"
            f"*ELASTIC,TYPE=ENGINEERING CONSTANTS\n{young:.10g},{young:.10g},{young:.10g},0,0,0,"
            f"{shear * factor:.10g},{shear * factor:.10g}\n{shear * factor:.10g},294.\n"
            f"*DENSITY\n{weight:.10g}\n"
            f"*BEAM SECTION,ELSET=E{k},MATERIAL=M{k},SECTION=RECT,ORIENTATION=O{k}\n"
            f"{side * wide:.10g},{side * wide:.10g}\n{y}\n"
        ).encode()


def _skin(skin: SolidSkin, model: BeamMesh, material: Material) -> Iterator[bytes]:
    """Wedges and what follows them, behind the beams."""
    mesh, first, number = skin.mesh, len(model.nodes), len(model.elements)
    for name, chosen, factor in (("SKIN", ~mesh.is_pad, 1.0), ("PADS", mesh.is_pad, PAD_STIFFNESS)):
        if not chosen.any():
            continue
        table = mesh.elements[chosen] + first
        yield from element_block("C3D15", name, number + np.arange(len(table)), table)
        number += len(table)
        yield (
            f"*MATERIAL,NAME={name}\n*ELASTIC\n{material.young * factor:.10g},"
            f"{material.poisson:.10g}\n*DENSITY\n{material.density * 1e-9:.10g}\n"
            f"*SOLID SECTION,ELSET={name},MATERIAL={name}\n*ELSET,ELSET=EALL\n{name}\n"
        ).encode()
    for follower, leaders, weights in zip(
        (skin.followers + 1).tolist(), skin.leaders + 1, skin.weights, strict=True
    ):
        for axis in range(3):
            row, column = np.nonzero(weights[:, axis])
            terms = [f"{follower},{axis + 1},-1."]
            terms += [
                f"{node},{way + 1},{value:.12g}"
                for node, way, value in zip(
                    leaders[row].tolist(), column.tolist(), weights[row, axis, column], strict=True
                )
            ]
            lines = [",".join(terms[k : k + 4]) for k in range(0, len(terms), 4)]
            yield f"*EQUATION\n{len(terms)}\n".encode() + "\n".join(lines).encode() + b"\n"
    for axis in (1, 2, 3) if len(skin.springs) else ():
        springs = number + np.arange(len(skin.springs))
        yield from element_block("SPRING2", f"S{axis}", springs, skin.springs)
        number += len(skin.springs)
        # By its decimal point CalculiX tells a stiffness from degrees of freedom.
        yield f"*SPRING,ELSET=S{axis}\n{axis},{axis}\n{skin.stiffness:.10e}\n".encode()


def _masses(attached: Floats, first: int) -> Iterator[bytes]:
    """Points with a mass, whose elements have the numbers from `first`."""
    nodes = np.flatnonzero(attached)
    for k, node in enumerate(nodes.tolist()):
        yield from element_block("MASS", f"A{k}", np.array([first + k]), np.array([[node]]))
        yield f"*MASS,ELSET=A{k}\n{attached[node]:.12g}\n".encode()


def _boundary(fixed: Bools) -> str:
    lines = ["*BOUNDARY\n"]
    for axis in range(6):
        lines += [f"{node + 1},{axis + 1},{axis + 1}\n" for node in np.flatnonzero(fixed[:, axis])]
    return "".join(lines)


def _static(case: Case) -> str:
    lines = ["*STEP\n*STATIC\n"]
    if case.prescribed is not None:
        lines.append("*BOUNDARY,OP=MOD\n")
        for node, axis in np.argwhere(case.fixed):
            value = case.prescribed[node, axis]
            lines.append(f"{node + 1},{axis + 1},{axis + 1},{value:.12g}\n")
    lines += _loads(case, 1.0)
    lines.append("*NODE PRINT,NSET=NALL\nU\n*EL FILE,OUTPUT=2D,SECTION FORCES\nS\n*END STEP\n")
    return "".join(lines)


def _loads(case: Case, scale: float) -> list[str]:
    lines = ["*CLOAD,OP=NEW\n"]
    for node, axis in np.argwhere((case.loads != 0.0) & ~case.fixed):
        lines.append(f"{node + 1},{axis + 1},{scale * case.loads[node, axis]:.12g}\n")
    lines.append("*DLOAD,OP=NEW\n")
    if any(case.acceleration):
        size = float(np.linalg.norm(case.acceleration))
        way = ",".join(f"{value / size:.12g}" for value in case.acceleration)
        lines.append(f"EALL,GRAV,{scale * size:.12g},{way}\n")
    return lines


def _buckling(case: Case, scale: float) -> str:
    return "".join(["*STEP\n*BUCKLE\n4\n", *_loads(case, scale), "*END STEP\n"])
