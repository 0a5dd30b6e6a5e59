# SPDX-License-Identifier: LGPL-2.1-or-later
"""From the results of FreeCAD's FEM workbench to fields of values at points."""

from __future__ import annotations

import FreeCAD as App
import numpy as np

from volfrep.design.scattered_field import PointField
from volfrep.util.errors import VolfrepError

from .solids import parent_placement

#: Taken where the user names no quantity.
DEFAULT_QUANTITY = "vonMises"


def field_of_result(result: App.DocumentObject, quantity: str, frame: App.Placement) -> PointField:
    """A quantity of a FEM result at the nodes of its mesh.

    FreeCAD meshes a part where it lies in the document, so the nodes are taken to lie where the
    result's mesh shows.

    Args:
        result: a solver's result object, a Fem::FemResultObject.
        quantity: name of one of its lists of a number per node, such as ``vonMises`` (which is
            also what an empty name means) or ``PrincipalMax``.
        frame: the coordinate system that the points are wanted in.

    Raises:
        VolfrepError: the object is no result, is empty, or lacks the quantity.
    """
    quantity = quantity.strip() or DEFAULT_QUANTITY
    label = result.Label
    if not result.isDerivedFrom("Fem::FemResultObject"):
        raise VolfrepError(
            f"'{label}' is no FEM result: choose the object with the results of a solver, such as "
            "CCX_Results, as RadiusResult."
        )
    numbers = np.array(result.NodeNumbers, np.int64)
    if result.Mesh is None or not len(numbers):
        raise VolfrepError(f"The FEM result '{label}' is empty: run the solver.")
    values = _values(result, quantity, len(numbers))
    points = _points(result, numbers)
    to_frame = frame.inverse().multiply(parent_placement(result.Mesh))
    matrix = np.array(to_frame.toMatrix().A).reshape(4, 4)
    placed = points @ matrix[:3, :3].T + matrix[:3, 3]
    return PointField(placed, values, source=f"{label}, {quantity}")


def _points(result: App.DocumentObject, numbers: np.ndarray) -> np.ndarray:
    """(n, 3) where the nodes of these numbers lie; values come in the numbers' order."""
    nodes = result.Mesh.FemMesh.Nodes  # FreeCAD hands them out one by one only
    known = np.array(sorted(nodes), np.int64)
    coordinates = np.array([tuple(nodes[number]) for number in known], np.float64).reshape(-1, 3)
    lost = np.setdiff1d(numbers, known)
    if not len(lost):
        return coordinates[np.searchsorted(known, numbers)]
    # A mesh that was saved has its nodes numbered anew, from 1 and in the same order, and the
    # result keeps the old numbers.
    old = np.unique(numbers)
    if len(old) == len(known) and known[-1] == len(known):
        return coordinates[np.searchsorted(old, numbers)]
    raise VolfrepError(
        f"The FEM result '{result.Label}' has values at node {lost[0]}, which its mesh "
        f"'{result.Mesh.Label}' does not have: run the solver again."
    )


def _values(result: App.DocumentObject, quantity: str, count: int) -> np.ndarray:
    """(count,) the quantity's values; count is that of the nodes."""
    offered = {
        name: getattr(result, name)
        for name in result.PropertiesList
        if result.getTypeIdOfProperty(name) == "App::PropertyFloatList"
    }
    filled = [name for name, values in offered.items() if len(values) == count]
    if quantity not in filled:
        choice = f"choose {', '.join(filled)} as RadiusColumn" if filled else "run the solver"
        raise VolfrepError(
            f"The FEM result '{result.Label}' has no number '{quantity}' at each of its {count} "
            f"nodes: {choice}."
        )
    return np.array(offered[quantity], np.float64)
