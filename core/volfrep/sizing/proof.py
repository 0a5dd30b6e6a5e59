# SPDX-License-Identifier: LGPL-2.1-or-later
"""The same beams and skin solved by CalculiX: how far the two agree.

The deck has the same struts, joints, supports and loads; a cone is steps there, beams are expanded
into solid elements, and a skin is of second-order wedges. Its files go to a temporary folder.

CalculiX makes rigid knots where sections or directions change, and with Poisson's ratio a stepped
cone is too stiff: so the deck has none, and gives the shear modulus by itself with an orientation
along each strut.
"""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from subprocess import CompletedProcess

import numpy as np

from ..fem.beam_mesh import BeamMesh
from ..fem.wedge_mesh import WedgeMesh
from ..io.write.calculix import SQUARE, width_of_ends
from ..io.write.step import rows
from ..mechanics.frame import SQUARE_SECTION
from ..mechanics.materials import Material
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.subprocesses import run_program
from ..util.threads import threads
from ..util.types import Bools, Floats, Ints
from .structure import Case
from .tapered_beams import Beams

_BLOCK = re.compile(r"^ displacements .*?\n\n((?: +\d+(?: +\S+){3}\n)*)", re.MULTILINE)
#: The first row of its table of load factors.
_FIRST = re.compile(r"^ +1 +(\S+)$", re.MULTILINE)
#: CalculiX sees no load factors below 1, and those far above it badly: what it is given is scaled
#: so that it finds about this one.
_FACTOR = 10.0
_ROW = 12
#: Struts whose directions differ by less share an orientation.
DIRECTION = 1e-6
#: Shear modulus of a single square element over what makes it twist and slide as the square does.
SQUARE_SHEAR = 0.5 * (SQUARE_SECTION.torsion + SQUARE_SECTION.shear)
#: How much stiffer the skin is where struts stand on it, through its whole thickness: with it
#: skinned boxes bend as their tetrahedra do.
PAD_STIFFNESS = 1.5


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
class Proof:
    """What CalculiX says of a frame.

    Attributes:
        displacements: (nodes, 3, cases) of all nodes of the deck, mm.
        sections: (nodes, 3, cases) the pull in the beams, N, and the moments about the two axes of
            their section, N mm: at nodes between equal elements of a strut.
        frequencies: (modes,) Hz.
        factors: (cases,) how many times the loads may be before the frame buckles; nan where that
            was not asked for.
    """

    displacements: Floats
    sections: Floats
    frequencies: Floats
    factors: Floats


def prove(
    model: BeamMesh,
    material: Material,
    cases: Sequence[Case],
    *,
    skin: SolidSkin | None = None,
    more_nodes: Floats | None = None,
    modes: int = 0,
    expected: Floats | None = None,
    monitor: Monitor | None = None,
) -> Proof:
    """Solve beams by CalculiX.

    Args:
        model: the beams.
        material: of the struts.
        cases: what they carry; their nodes are the beams' and those of the skin.
        skin: about them; None for none.
        more_nodes: (h, 3) nodes behind those of the skin, which only follow others, mm.
        modes: how many frequencies, with the first case's supports.
        expected: (cases,) near which load factor each case buckles, nan where that is not asked
            for; None for nowhere.
        monitor: asked for a cancel while CalculiX runs.

    Raises:
        VolfrepError: CalculiX is not installed, or does not solve it.
        Cancelled: when the monitor says so.
    """
    program = shutil.which("ccx")
    if program is None:
        raise VolfrepError(
            "CalculiX (ccx) is not installed: install it ('apt-get install calculix-ccx')."
        )
    alike: list[list[int]] = []
    for k, case in enumerate(cases):
        same = next((g for g in alike if np.array_equal(cases[g[0]].held, case.held)), None)
        alike.append([k]) if same is None else same.append(k)
    nodes = model.nodes
    if skin is not None:
        nodes = np.concatenate([nodes, skin.mesh.nodes])
    if more_nodes is not None:
        nodes = np.concatenate([nodes, more_nodes])
    moved = np.zeros((len(nodes), 3, len(cases)))
    sections = np.zeros((len(nodes), 3, len(cases)))
    frequencies = np.zeros(0)
    factors = np.full(len(cases), np.nan)
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads())}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for group in alike:
            steps = [_static(cases[k]) for k in group]
            if modes and 0 in group:
                steps.append(f"*STEP\n*FREQUENCY\n{modes}\n*END STEP\n")
            held = _held(cases[group[0]].held)

            def solved(steps: Sequence[str], held: str = held) -> CompletedProcess[str]:
                with (folder / "job.inp").open("wb") as deck:
                    deck.writelines(_deck(nodes, model, material))
                    if skin is not None:
                        deck.writelines(_skin(skin, model, material))
                    deck.write(held.encode())
                    deck.writelines(step.encode() for step in steps)
                return run_program([program, "-i", "job"], folder, monitor, environment)

            said = solved(steps)
            printed = folder / "job.dat"
            text = printed.read_text(errors="replace") if printed.is_file() else ""
            blocks = _BLOCK.findall(text)
            if said.returncode or len(blocks) < len(group):
                reason = [line for line in said.stdout.splitlines() if "ERROR" in line]
                detail = f": {reason[0].strip().rstrip('.')}" if reason else ""
                raise VolfrepError(f"CalculiX did not solve the frame{detail}.")
            for k, block in zip(group, blocks, strict=False):
                table = np.array(block.split(), np.float64).reshape(-1, 4)
                moved[table[:, 0].astype(np.int64) - 1, :, k] = table[:, 1:]
            for k, table in zip(group, _section_forces(folder / "job.frd"), strict=False):
                number = table[:, 0].astype(np.int64) - 1
                sections[number, :, k] = table[:, [3, 5, 6]]
            if modes and 0 in group:
                frequencies = _frequencies(text)[:modes]
            for k in group:
                near = np.nan if expected is None else float(expected[k])
                if np.isfinite(near):
                    scale = near / _FACTOR
                    solved([_buckling(cases[k], scale)])
                    found = _FIRST.search(printed.read_text(errors="replace"))
                    if found is None:
                        raise VolfrepError("CalculiX found no load at which the frame buckles.")
                    factors[k] = scale * float(found[1])
    return Proof(moved, sections, frequencies, factors)


def end_stresses(proof: Proof, model: BeamMesh, beams: Beams, radii: Floats) -> Floats:
    """(m, 2, cases) MPa, |pull| / A + |M| / W where struts leave their joints; nan where unknown.

    A moment is linear along a strut, and CalculiX's are right between equal elements: so it is
    taken from two such nodes, and drawn on to the ends. Struts of less than three elements have
    none.
    """
    inner = ~model.is_joint
    inner[1:] &= ~model.is_joint[:-1] & (model.strut[1:] == model.strut[:-1])
    inner[0] = False
    before = np.flatnonzero(inner)  # elements that begin between two flexible ones
    strut = model.strut[before]
    result = np.full((len(radii), 2, proof.sections.shape[2]), np.nan)
    edge = np.flatnonzero(np.append(True, strut[1:] != strut[:-1]))
    last = np.append(edge[1:], len(strut)) - 1
    many = last > edge
    first, last = model.elements[before[edge[many]], 0], model.elements[before[last[many]], 0]
    own = strut[edge[many]]
    start = model.nodes[beams.struts[own, 0]]
    near, far = (np.linalg.norm(model.nodes[node] - start, axis=1) for node in (first, last))
    stiff, length = beams.stiff_lengths(radii)[own], beams.length[own]
    for end, place in ((0, stiff[:, 0]), (1, length - stiff[:, 1])):
        share = ((place - near) / (far - near))[:, None, None]
        felt = proof.sections[first] * (1.0 - share) + proof.sections[last] * share
        along = (place / length)[:, None]
        radius = radii[own, :1] * (1.0 - along) + radii[own, 1:] * along
        pull = np.abs(felt[:, 0]) / (np.pi * radius**2)
        result[own, end] = pull + np.hypot(felt[:, 1], felt[:, 2]) / (0.25 * np.pi * radius**3)
    return result


def _deck(nodes: Floats, model: BeamMesh, material: Material) -> Iterator[bytes]:
    """Nodes, elements and sections.

    CalculiX makes rigid knots where sections or directions change, which hinder a material's
    lateral contraction: with Poisson's ratio, ten steps of a cone are 6 % too stiff. So there is
    none here, and the modulus of shear is given by itself, which takes an orientation along the
    strut. A square of one element has the torsion of its polar moment and no shear coefficient:
    both go into that modulus, too.
    """
    yield b"*NODE,NSET=NALL\n"
    yield from rows("%d,%.12g,%.12g,%.12g\n", np.arange(1, len(nodes) + 1), nodes)
    ends = model.nodes[model.elements]
    along = ends[:, 1] - ends[:, 0]
    along /= np.linalg.norm(along, axis=1)[:, None]
    names = np.round(along / DIRECTION).astype(np.int64)
    key = np.column_stack([names, model.section, model.is_joint])
    _, first, group = np.unique(key, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(group.ravel(), kind="stable")
    for k, chosen in enumerate(np.split(order, np.cumsum(np.bincount(group.ravel()))[:-1])):
        yield f"*ELEMENT,TYPE=B31,ELSET=E{k}\n".encode()
        yield from rows("%d,%d,%d\n", chosen + 1, model.elements[chosen] + 1)
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
            factor, wide = fitted.axial**2 / fitted.bending, width_of_ends(fitted)
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
    mesh, first, number = skin.mesh, len(model.nodes), len(model.elements) + 1
    for name, chosen, factor in (("SKIN", ~mesh.is_pad, 1.0), ("PADS", mesh.is_pad, PAD_STIFFNESS)):
        if not chosen.any():
            continue
        yield f"*ELEMENT,TYPE=C3D15,ELSET={name}\n".encode()
        table = mesh.elements[chosen] + first + 1
        line = "%d" + ",%d" * 11 + "\n" + "%d" + ",%d" * 3 + "\n"
        yield from rows(line, number + np.arange(len(table)), table)
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
        yield f"*ELEMENT,TYPE=SPRING2,ELSET=S{axis}\n".encode()
        yield from rows("%d,%d,%d\n", number + np.arange(len(skin.springs)), skin.springs + 1)
        number += len(skin.springs)
        yield f"*SPRING,ELSET=S{axis}\n{axis},{axis}\n{skin.stiffness:.10g}\n".encode()


def _held(held: Bools) -> str:
    lines = ["*BOUNDARY\n"]
    for axis in range(6):
        lines += [f"{node + 1},{axis + 1},{axis + 1}\n" for node in np.flatnonzero(held[:, axis])]
    return "".join(lines)


def _static(case: Case) -> str:
    lines = ["*STEP\n*STATIC\n"]
    if case.moved is not None:
        lines.append("*BOUNDARY,OP=MOD\n")
        for node, axis in np.argwhere(case.held):
            value = case.moved[node, axis]
            lines.append(f"{node + 1},{axis + 1},{axis + 1},{value:.12g}\n")
    lines += _loads(case, 1.0)
    lines.append(
        "*NODE PRINT,NSET=NALL\nU\n*NODE FILE,OUTPUT=2D\nU\n*EL FILE,SECTION FORCES\nS\n*END STEP\n"
    )
    return "".join(lines)


def _loads(case: Case, scale: float) -> list[str]:
    lines = ["*CLOAD,OP=NEW\n"]
    for node, axis in np.argwhere((case.loads != 0.0) & ~case.held):
        lines.append(f"{node + 1},{axis + 1},{scale * case.loads[node, axis]:.12g}\n")
    lines.append("*DLOAD,OP=NEW\n")
    if any(case.acceleration):
        size = float(np.linalg.norm(case.acceleration))
        way = ",".join(f"{value / size:.12g}" for value in case.acceleration)
        lines.append(f"EALL,GRAV,{scale * size:.12g},{way}\n")
    return lines


def _buckling(case: Case, scale: float) -> str:
    return "".join(["*STEP\n*BUCKLE\n4\n", *_loads(case, scale), "*END STEP\n"])


def _frequencies(text: str) -> Floats:
    """Hz, of CalculiX's table of eigenvalues."""
    start = text.index("E I G E N V A L U E   O U T P U T")
    rows = []
    for line in text[start:].splitlines()[1:]:
        parts = line.split()
        if len(parts) == 5 and parts[0].isdigit():
            rows.append(float(parts[3]))
        elif rows:
            break
    return np.array(rows)


def _section_forces(path: Path) -> list[Floats]:
    """For every static step (n, 7): node, and the six components of its section forces."""
    tables: list[Floats] = []
    found: list[list[float]] = []
    inside = False
    with path.open(encoding="ascii", errors="replace") as lines:
        for line in lines:
            if line.startswith(" -4  STRESS"):
                inside, found = True, []
            elif inside and line.startswith(" -1"):
                values = line[13:].rstrip("\n")
                found.append(
                    [float(line[3:13])]
                    + [float(values[k : k + _ROW]) for k in range(0, 6 * _ROW, _ROW)]
                )
            elif inside and line.startswith(" -3"):
                tables.append(np.array(found))
                inside = False
    return tables
