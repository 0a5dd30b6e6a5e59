# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice as STEP solids with exact surfaces: the text of each kind of joint at its places.

Somebody who can fuse exact surfaces (OpenCASCADE, through FreeCAD) makes each kind of joint once
and writes it as STEP. Here the copies are made in the text: points are moved, directions shared,
the flat caps in the middle of the struts left out, and the circles there written by one of the
two joints and used by both. So the shells are closed without sewing anything.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...grid.congruent_joints import Joint, Unsuitable, distinct_joints
from ...grid.strut_graph import Wireframe
from ...mesh.topology import pieces_of
from ...util.errors import VolfrepError
from ...util.files import replacing
from ...util.text_rows import rows
from ...util.types import Floats, Ints
from .step import CLOSING, CONTEXT, FIRST_FREE, PLACEMENT, opening, product, references

#: Joints must meet within this, mm.
TOLERANCE = 1e-6
#: Measured in FreeCAD 0.20.2, for the six cells and random radii: to fuse a joint, by its arms
#: squared, and more where they are cones; to write an arm; its bytes in the file.
SECONDS_PER_ARM_SQUARED = 4e-3
SECONDS_OF_CONES = 6e-3
WRITE_SECONDS_PER_ARM = 6e-5
BYTES_PER_ARM = 1950
BYTES_OF_CONES = 12_000

_POINT = "(%#.12G,%#.12G,%#.12G)"
_ENTITY = re.compile(r"#(\d+)\s*=\s*(.*?);\s*(?=#|ENDSEC)", re.DOTALL)
_REFERENCE = re.compile(r"#(\d+)")
_REAL = r"\s*([-+.\dE]+)\s*"
_COORDINATES = re.compile(rf"CARTESIAN_POINT\('',\({_REAL},{_REAL},{_REAL}\)\)")


@dataclass(frozen=True)
class Prediction:
    """What exact surfaces will cost.

    Attributes:
        kinds: different joints to fuse.
        seconds: to make the file.
        megabytes: its size.
        read_seconds: that FreeCAD will take to read it.
    """

    kinds: int
    seconds: float
    megabytes: float
    read_seconds: float


@dataclass(frozen=True, eq=False)
class JointText:
    """One kind of joint as STEP text without its caps.

    Attributes:
        joint: the kind, with its places.
        template: the entities of one copy, to be filled in.
        places: what fills the template, in order: an own entity (its place among the copy's), a
            point, or the edge or the vertex of an arm's cap.
        entities: how many a copy has.
        faces: which of them are its faces.
        caps: (k, 2) the edge and the vertex of each arm's cap; -1 where the other joint has them.
        seams: (k, 6) where the cap's vertex lies, seen from its centre, and the circle's axis.
    """

    joint: Joint
    template: str
    places: tuple[tuple[str, int], ...]
    points: Floats
    entities: int
    faces: Ints
    caps: Ints
    seams: Floats


@dataclass(eq=False)
class Shared:
    """Entities that do not depend on a joint's place, each text once."""

    first: int = FIRST_FREE
    numbers: dict[str, int] = field(default_factory=dict)

    def number(self, text: str) -> int:
        """The number of the entity of that text."""
        return self.numbers.setdefault(text, self.first + len(self.numbers))

    @property
    def end(self) -> int:
        """The first number behind them."""
        return self.first + len(self.numbers)


def owns(arms: Floats) -> NDArray[np.bool_]:
    """(k,) which arms write the circle in the middle of their strut: one of each two halves."""
    steps = np.round(arms / TOLERANCE).astype(np.int64)
    last = np.where(steps[:, 1] != 0, steps[:, 1], steps[:, 2])
    result: NDArray[np.bool_] = np.where(steps[:, 0] != 0, steps[:, 0], last) > 0
    return result


def joint_text(joint: Joint, step: str, shared: Shared) -> JointText:
    """Take a joint's STEP file apart.

    Args:
        joint: the kind.
        step: the file of one closed solid: this joint at the origin, flat at its arms' ends,
            without curves in parameter space.
        shared: takes the directions.

    Raises:
        Unsuitable: the struts overlap as far as their middles, or the file is not of that kind.
    """
    body = {
        int(number): re.sub(r"\s+", "", text)
        for number, text in _ENTITY.findall(step[step.index("DATA;") :])
    }
    uses = {number: [int(k) for k in _REFERENCE.findall(text)] for number, text in body.items()}
    point = {
        number: np.array([float(x) for x in match.groups()])
        for number, text in body.items()
        if (match := _COORDINATES.fullmatch(text))
    }
    shells = [number for number, text in body.items() if text.startswith("CLOSED_SHELL(")]
    if len(shells) != 1:
        raise Unsuitable("is not one closed surface")

    edges = [_cap(joint, arm, body, uses, point) for arm in range(len(joint.arms))]
    faces = [face for face in uses[shells[0]] if not _is_cap(face, edges, body, uses)]
    if len(uses[shells[0]]) - len(faces) != len(edges):
        raise Unsuitable("has struts that overlap as far as their middles")

    own = owns(joint.arms)
    foreign: dict[int, tuple[str, int]] = {}
    for arm in np.flatnonzero(~own).tolist():
        foreign[edges[arm]] = ("edge", arm)
        foreign[uses[edges[arm]][0]] = ("vertex", arm)
    order = _own_faces(faces, foreign, body, uses)
    local = {number: k for k, number in enumerate(order)}

    text: list[str] = []
    places: list[tuple[str, int]] = []
    points: list[Floats] = []
    for number in order:
        places.append(("own", local[number]))
        if number in point:
            places.append(("point", len(points)))
            points.append(point[number])
            text.append(f"#%d=CARTESIAN_POINT('',{_POINT});\n")
            continue
        for used in uses[number]:
            if used in foreign:
                places.append(foreign[used])
            elif used in local:
                places.append(("own", local[used]))
        written = _REFERENCE.sub(
            lambda match: (
                "#%d"
                if int(match[1]) in local or int(match[1]) in foreign
                else f"#{_share(int(match[1]), body, uses, shared)}"
            ),
            body[number],
        )
        text.append(f"#%d={written};\n")
    caps = np.full((len(edges), 2), -1)
    for arm in np.flatnonzero(own).tolist():
        caps[arm] = local[edges[arm]], local[uses[edges[arm]][0]]
    return JointText(
        joint,
        "".join(text),
        tuple(places),
        np.array(points),
        len(order),
        np.array([local[face] for face in faces]),
        caps,
        np.array([_seam(edge, body, uses, point) for edge in edges]),
    )


def write_step_exact(
    wireframe: Wireframe,
    texts: Sequence[JointText],
    shared: Shared,
    path: str | os.PathLike[str],
) -> None:
    """Write a lattice as one closed solid for each of its connected pieces.

    Args:
        wireframe: the lattice, mm.
        texts: all its kinds of joints.
        shared: what they share.
        path: of the file; an old file stays if anything goes wrong.

    Raises:
        VolfrepError: two joints do not meet, or the path cannot be written.
    """
    _check_seams(texts, len(wireframe.struts))
    count = [len(text.joint.places) for text in texts]
    sizes = np.array([text.entities for text in texts]) * count
    starts = shared.end + np.concatenate([[0], np.cumsum(sizes)])
    bases = [
        start + text.entities * np.arange(copies)
        for start, text, copies in zip(starts, texts, count, strict=False)
    ]
    caps = np.zeros((len(wireframe.struts), 2), np.int64)
    for text, base in zip(texts, bases, strict=True):
        for arm in np.flatnonzero(text.caps[:, 0] >= 0):
            caps[text.joint.struts[:, arm]] = base[:, None] + text.caps[arm]
    name = Path(path).stem
    with replacing(path) as file:
        file.write(opening(name, "exact surfaces").encode("ascii"))
        file.writelines(f"#{k}={text};\n".encode("ascii") for text, k in shared.numbers.items())
        for text, base in zip(texts, bases, strict=True):
            file.writelines(_copies(text, base, caps, wireframe.nodes))
        file.write(_solids(wireframe, texts, bases, int(starts[-1]), name).encode("ascii"))


def _cap(
    joint: Joint,
    arm: int,
    body: dict[int, str],
    uses: dict[int, list[int]],
    point: dict[int, Floats],
) -> int:
    """The edge around the flat end of an arm: one whole circle."""
    found = []
    for number, text in body.items():
        if not text.startswith("EDGE_CURVE("):
            continue
        start, end, curve = uses[number]
        if body[curve].startswith("CIRCLE("):
            centre = point[uses[uses[curve][0]][0]]
            if np.abs(centre - joint.arms[arm]).max() < TOLERANCE:
                found.append((number, start == end))
    if len(found) != 1 or not found[0][1]:
        raise Unsuitable("has struts that overlap as far as their middles")
    return found[0][0]


def _is_cap(face: int, edges: list[int], body: dict[int, str], uses: dict[int, list[int]]) -> bool:
    bounds, surface = uses[face][:-1], uses[face][-1]
    if not body[surface].startswith("PLANE(") or len(bounds) != 1:
        return False
    loop = uses[uses[bounds[0]][0]]
    return len(loop) == 1 and uses[loop[0]][0] in edges


def _own_faces(
    faces: list[int],
    foreign: dict[int, tuple[str, int]],
    body: dict[int, str],
    uses: dict[int, list[int]],
) -> list[int]:
    """The entities of the faces, less those that are shared or another joint's."""
    seen, waiting = set(faces), list(faces)
    while waiting:
        for used in uses[waiting.pop()]:
            if used in seen or used in foreign or body[used].startswith(("DIRECTION(", "VECTOR(")):
                continue
            seen.add(used)
            waiting.append(used)
    return sorted(seen)


def _share(number: int, body: dict[int, str], uses: dict[int, list[int]], shared: Shared) -> int:
    text = body[number]
    for used in uses[number]:
        text = text.replace(f"#{used},", f"#{_share(used, body, uses, shared)},")
    return shared.number(text)


def _seam(
    edge: int, body: dict[int, str], uses: dict[int, list[int]], point: dict[int, Floats]
) -> Floats:
    """Where the vertex of a cap's circle lies from its centre, and the way the edge turns."""
    vertex, _, curve = uses[edge]
    centre, axis, *_ = uses[uses[curve][0]]
    turn = np.array([float(x) for x in re.findall(_REAL, body[axis].split("(", 2)[2]) if x != "."])
    sense = 1.0 if body[edge].endswith(".T.)") else -1.0
    return np.concatenate([point[uses[vertex][0]] - point[centre], sense * turn])


def _check_seams(texts: Sequence[JointText], struts: int) -> None:
    """Refuse joints whose circles do not begin at the same point or turn the other way."""
    seams = np.full((2, struts, 6), np.nan)
    for text in texts:
        for arm, own in enumerate(text.caps[:, 0] >= 0):
            seams[int(own), text.joint.struts[:, arm]] = text.seams[arm]
    apart = ~(np.abs(seams[0] - seams[1]).max(axis=1) < TOLERANCE)
    if apart.any():
        raise VolfrepError(
            f"{int(apart.sum())} of the struts have two halves that do not meet: use the faceted "
            "STEP form."
        )


def _copies(text: JointText, base: Ints, caps: Ints, nodes: Floats) -> Iterator[bytes]:
    place = nodes[text.joint.places]
    columns: list[NDArray[np.generic]] = []
    for kind, index in text.places:
        if kind == "own":
            columns.append(base + index)
        elif kind == "point":
            # Whole billionths of a millimetre: no digits of rounding noise.
            columns.append(np.round(place + text.points[index], 9) + 0.0)
        else:
            columns.append(caps[text.joint.struts[:, index], 0 if kind == "edge" else 1])
    yield from rows(text.template, *columns)


def _solids(
    wireframe: Wireframe, texts: Sequence[JointText], bases: list[Ints], first: int, name: str
) -> str:
    """A closed shell and a solid for each connected piece, their representation, the product."""
    start, end = wireframe.struts.T
    piece_of_node = pieces_of(start, end, len(wireframe.nodes))[1]
    faces = np.concatenate(
        [(base[:, None] + text.faces).ravel() for text, base in zip(texts, bases, strict=True)]
    )
    pieces = np.concatenate(
        [np.repeat(piece_of_node[text.joint.places], len(text.faces)) for text in texts]
    )
    out, solids, number = [], [], first
    for piece in np.unique(pieces):
        out.append(
            f"#{number}=CLOSED_SHELL('',({references(faces[pieces == piece])}));\n"
            f"#{number + 1}=MANIFOLD_SOLID_BREP('',#{number});\n"
        )
        solids.append(number + 1)
        number += 2
    items = references(np.array([PLACEMENT, *solids]))
    out.append(f"#{number}=ADVANCED_BREP_SHAPE_REPRESENTATION('',({items}),#{CONTEXT});\n")
    return "".join(out) + product(number + 1, name, number) + CLOSING


def predict_exact(wireframe: Wireframe) -> Prediction:
    """What fusing and writing a lattice will take."""
    joints = distinct_joints(wireframe)
    seconds = megabytes = 0.0
    for joint in joints:
        arms = len(joint.arms)
        cones = int(np.count_nonzero(np.abs(np.diff(joint.radii, axis=1)) > TOLERANCE))
        share = cones / arms
        seconds += arms**2 * (SECONDS_PER_ARM_SQUARED + share * SECONDS_OF_CONES)
        megabytes += 1e-6 * len(joint.places) * arms * (BYTES_PER_ARM + share * BYTES_OF_CONES)
    arms = 2 * len(wireframe.struts)
    return Prediction(len(joints), seconds + arms * WRITE_SECONDS_PER_ARM, megabytes, 2e-3 * arms)
