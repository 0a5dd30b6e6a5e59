# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input decks for CalculiX (and, as far as beams and tetrahedra go, for Abaqus): mm, N, MPa."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ..mechanics.frame import Ends
from ..mechanics.materials import Material
from ..util.files import replacing
from ..util.text_rows import rows
from ..util.types import Floats, Ints
from .beam_mesh import BeamMesh
from .tet_mesh import TetrahedralMesh

#: Side of the square whose second moment of area is that of a circle of radius 1.
SQUARE = (3.0 * np.pi) ** 0.25
#: Nodes this near to the outermost one along an axis, in mm, are on that side.
SIDE_TOLERANCE = 1e-6
SIDES = ("XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX")
#: Of a deck of beams, per beam: bytes, seconds to write it, seconds to solve it; measured on
#: blocks of 500 to 50,000 beams.
BYTES_PER_BEAM = 57
WRITE_SECONDS_PER_BEAM = 1e-6
SOLVE_SECONDS_PER_BEAM = 4e-4
_PER_LINE = 10
#: Numbers a line of an element; its other nodes stand on the next one.
_ENTRIES = 12


def sides(nodes: Floats) -> dict[str, Ints]:
    """The nodes on each side of their box, by the names `SIDES`."""
    low, high = nodes.min(axis=0), nodes.max(axis=0)
    found = {}
    for axis, letter in enumerate("XYZ"):
        found[f"{letter}MIN"] = np.flatnonzero(nodes[:, axis] <= low[axis] + SIDE_TOLERANCE)
        found[f"{letter}MAX"] = np.flatnonzero(nodes[:, axis] >= high[axis] - SIDE_TOLERANCE)
    return found


def write_beams(
    model: BeamMesh,
    path: str | os.PathLike[str],
    material: Material | None = None,
    *,
    on_boundary: NDArray[np.bool_] | None = None,
) -> None:
    """Write beams as elements B31.

    CalculiX expands beams into solid elements and offers round sections for the three-noded ones
    only, which take ten times as long to solve as two-noded ones. So the section is the square
    of the same second moment of area as the circle (2 % less area, 15 % less torsion); stresses
    of the round strut follow from the section forces. Constraints and loads are left to whoever
    includes the deck.

    Node sets: NALL, JOINTS (the lattice's nodes), SKIN (its nodes on the skin, where given), and
    the nodes on the sides of the lattice's box: XMIN, XMAX, ... ZMAX. Element sets: EALL, STRUTS
    (the flexible middles) and ENDS (the stiff ends).

    Args:
        model: the beams.
        path: of the file (.inp); an old file stays if anything goes wrong.
        material: of the struts.
        on_boundary: (joints,) bool, nodes that the skin holds.

    Raises:
        VolfrepError: the path cannot be written.
    """
    material = material or Material()
    joints = np.arange(model.joints)
    sets = {"JOINTS": joints, **sides(model.nodes[: model.joints])}
    if on_boundary is not None:
        sets["SKIN"] = np.flatnonzero(on_boundary)
    groups = _groups(model)
    with replacing(path) as file:
        file.writelines(_opening("beams with stiff ends", model.nodes, sets))
        for name, chosen, _, _, _ in groups:
            file.writelines(element_block("B31", name, chosen, model.elements[chosen]))
        for whole, stiff in (("STRUTS", False), ("ENDS", True)):
            own = [name for name, _, is_joint, _, _ in groups if is_joint == stiff]
            if own:
                file.write(f"*ELSET,ELSET={whole}\n{_lines(own)}".encode())
        file.write(_material(material, 1.0, material.name))
        stiffened = stiff_materials(model, material.name)
        for stiff_name, factor in dict.fromkeys(stiffened):
            file.write(_material(material, factor, stiff_name))
        for name, _, stiff, section, normal in groups:
            of, side = material.name, SQUARE * float(model.radii[section])
            if stiff:
                of, side = stiffened[section][0], side * width_of_ends(model.ends[section])
            file.write(
                f"*BEAM SECTION,ELSET={name},MATERIAL={of},SECTION=RECT\n"
                f"{side:.10g},{side:.10g}\n{normal}\n".encode()
            )


def write_tetrahedra(
    mesh: TetrahedralMesh,
    path: str | os.PathLike[str],
    material: Material | None = None,
    *,
    sets: Mapping[str, Ints] | None = None,
) -> None:
    """Write second-order tetrahedra as elements C3D10, without constraints and loads.

    Args:
        mesh: the tetrahedra.
        path: of the file (.inp); an old file stays if anything goes wrong.
        material: of the part.
        sets: node sets by name, rows of the mesh's nodes; the sides of its box are added where
            they are not given.

    Raises:
        VolfrepError: the path cannot be written.
    """
    material = material or Material()
    named = {**sides(mesh.nodes), **(sets or {})}
    number = np.arange(len(mesh.elements))
    with replacing(path) as file:
        file.writelines(_opening("second-order tetrahedra", mesh.nodes, named))
        file.writelines(element_block("C3D10", "EALL", number, mesh.elements))
        file.write(_material(material, 1.0, material.name))
        file.write(f"*SOLID SECTION,ELSET=EALL,MATERIAL={material.name}\n".encode())


def node_block(nodes: Floats) -> Iterator[bytes]:
    """All nodes, mm, numbered from 1."""
    yield b"*NODE,NSET=NALL\n"
    yield from rows("%d,%.12g,%.12g,%.12g\n", np.arange(1, len(nodes) + 1), nodes)


def element_block(kind: str, name: str, numbers: Ints, nodes: Ints) -> Iterator[bytes]:
    """A set of elements of one kind; (e,) and (e, k) both count from 0 here, from 1 in the deck."""
    yield f"*ELEMENT,TYPE={kind},ELSET={name}\n".encode()
    entries = ["%d"] * (1 + nodes.shape[1])
    lines = [",".join(entries[k : k + _ENTRIES]) for k in range(0, len(entries), _ENTRIES)]
    yield from rows("\n".join(lines) + "\n", numbers + 1, nodes + 1)


def width_of_ends(ends: Ends) -> float:
    """How many times as wide as the strut's the section of its stiffened ends is.

    Stiffness when pulled goes with E times the width squared, when bent with the fourth power.
    """
    return float(np.sqrt(ends.bending / ends.axial))


def stiff_materials(model: BeamMesh, name: str) -> list[tuple[str, float]]:
    """For each section the name of its ends' material, and its E over the struts'."""
    factors = [f"{ends.modulus:.6g}" for ends in model.ends]
    kinds = list(dict.fromkeys(factors))
    number = {factor: str(k + 1) if len(kinds) > 1 else "" for k, factor in enumerate(kinds)}
    return [(f"{name}_END{number[factor]}", float(factor)) for factor in factors]


def _groups(model: BeamMesh) -> list[tuple[str, Ints, bool, int, str]]:
    """Elements of one section, stiffness and normal: name, rows, stiff, section, normal."""
    # The normal of a section may be any direction but the beam's own: the axis farthest from it.
    # It must not change along a strut (rounding breaks ties): CalculiX would make a stiff knot.
    ends = model.nodes[model.elements]
    along = np.abs(ends[:, 1] - ends[:, 0])
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    axis = np.argmin(np.round(along, 6), axis=1)
    key = (model.section * 2 + model.is_joint) * 3 + axis
    used, group = np.unique(key, return_inverse=True)
    by_group = np.split(
        np.argsort(group.ravel(), kind="stable"), np.cumsum(np.bincount(group.ravel()))[:-1]
    )
    normals = ("1.,0.,0.", "0.,1.,0.", "0.,0.,1.")
    return [
        (
            f"E{k + 1}",
            chosen,
            bool(value // 3 % 2),
            value // 6,
            normals[value % 3],
        )
        for k, (value, chosen) in enumerate(zip(used.tolist(), by_group, strict=True))
    ]


def _opening(title: str, nodes: Floats, sets: Mapping[str, Ints]) -> Iterator[bytes]:
    yield f"*HEADING\nVOLFREP, {title}; mm, N, MPa, t/mm3\n".encode()
    yield from node_block(nodes)
    for name, chosen in sets.items():
        if len(chosen):
            yield f"*NSET,NSET={name}\n".encode()
            yield from number_lines(chosen)


def _material(material: Material, factor: float, name: str) -> bytes:
    return (
        f"*MATERIAL,NAME={name}\n*ELASTIC\n{material.young * factor:.10g},{material.poisson:.10g}\n"
        f"*DENSITY\n{material.density * 1e-9:.10g}\n"
    ).encode()


def number_lines(chosen: Ints) -> Iterator[bytes]:
    """Node numbers, so many a line."""
    yield _lines((chosen + 1).tolist()).encode()


def _lines(values: Sequence[object]) -> str:
    return "".join(
        ",".join(map(str, values[k : k + _PER_LINE])) + "\n"
        for k in range(0, len(values), _PER_LINE)
    )
