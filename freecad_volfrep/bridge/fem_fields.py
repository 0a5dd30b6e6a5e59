# SPDX-License-Identifier: LGPL-2.1-or-later
"""From the results of FreeCAD's FEM workbench to fields of values at points.

Nodes are brought from where their mesh shows to the group that the infill lies in. FreeCAD numbers
nodes anew when it reopens a file: they are then matched by order.
"""

from __future__ import annotations

import io
import re
import zipfile
from typing import Any

import FreeCAD as App
import numpy as np

from volfrep.design.scattered_field import PointField
from volfrep.util.errors import VolfrepError

from .solids import parent_placement

#: Taken where the user names no quantity.
DEFAULT_QUANTITY = "vonMises"
#: What a pipeline calls the quantities of a result object.
PIPELINE_NAMES = {
    "vonMises": "von Mises Stress",
    "PrincipalMax": "Major Principal Stress",
    "PrincipalMed": "Intermediate Principal Stress",
    "PrincipalMin": "Minor Principal Stress",
    "MaxShear": "Tresca Stress",
    "DisplacementLengths": "Displacement",
}


def is_result(obj: App.DocumentObject) -> bool:
    """Whether an object is the result of a solver, of either kind."""
    return bool(
        obj.isDerivedFrom("Fem::FemResultObject") or obj.isDerivedFrom("Fem::FemPostPipeline")
    )


def field_of_result(
    result: App.DocumentObject,
    quantity: str,
    frame: App.Placement,
    named: tuple[str, str] = ("RadiusResult", "RadiusColumn"),
) -> PointField:
    """A quantity of a FEM result at the nodes of its mesh.

    FreeCAD meshes a part where it lies in the document, so the nodes are taken to lie where the
    result's mesh, or the pipeline, shows.

    Args:
        result: a solver's result object, a Fem::FemResultObject, or the pipeline that FreeCAD's
            newer solver makes in its place, a Fem::FemPostPipeline.
        quantity: name of one of its lists of a number per node, such as ``vonMises`` (which is
            also what an empty name means) or ``PrincipalMax``; of a pipeline these, or an array of
            its own such as ``Displacement``, of which the length counts.
        frame: the coordinate system that the points are wanted in.
        named: the properties that the result and the quantity are chosen by, for messages.

    Raises:
        VolfrepError: the object is no result, is empty, or lacks the quantity.
    """
    quantity = quantity.strip() or DEFAULT_QUANTITY
    label = result.Label
    if result.isDerivedFrom("Fem::FemPostPipeline"):
        points, values = _of_pipeline(result, quantity, named[1])
        place = parent_placement(result).multiply(result.Placement)
        return PointField(_placed(points, frame, place), values, source=f"{label}, {quantity}")
    if not result.isDerivedFrom("Fem::FemResultObject"):
        raise VolfrepError(
            f"'{label}' is no FEM result: choose the object with the results of a solver, such as "
            f"CCX_Results or SolverCalculiXResult, as {named[0]}."
        )
    numbers = np.array(result.NodeNumbers, np.int64)
    if result.Mesh is None or not len(numbers):
        raise VolfrepError(f"The FEM result '{label}' is empty: run the solver.")
    values = _values(result, quantity, len(numbers), named[1])
    points = _points(result, numbers)
    placed = _placed(points, frame, parent_placement(result.Mesh))
    return PointField(placed, values, source=f"{label}, {quantity}")


def _placed(points: np.ndarray, frame: App.Placement, place: App.Placement) -> np.ndarray:
    """(n, 3) points of one coordinate system in those of another."""
    matrix = np.array(frame.inverse().multiply(place).toMatrix().A).reshape(4, 4)
    placed: np.ndarray = points @ matrix[:3, :3].T + matrix[:3, 3]
    return placed


def _of_pipeline(
    pipeline: App.DocumentObject, quantity: str, column: str
) -> tuple[np.ndarray, np.ndarray]:
    """(n, 3) points and (n,) values of the step that a pipeline shows.

    Raises:
        VolfrepError: it is empty, lacks the quantity, or VTK is not installed for Python.
    """
    grid = _shown_grid(pipeline)
    from vtkmodules.util.numpy_support import vtk_to_numpy

    arrays = grid.GetPointData()
    found = {}
    for k in range(arrays.GetNumberOfArrays()):
        array = arrays.GetArray(k)
        if array is not None and array.GetNumberOfComponents() in (1, 3):
            found[array.GetName()] = array
    wanted = PIPELINE_NAMES.get(quantity, quantity).lower()
    name = next((name for name in found if name.lower() == wanted), None)
    if name is None:
        raise VolfrepError(
            f"The FEM result '{pipeline.Label}' has no '{quantity}': choose {', '.join(found)} as "
            f"{column}."
        )
    values = vtk_to_numpy(found[name]).astype(np.float64)
    if values.ndim == 2:
        values = np.linalg.norm(values, axis=1)
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(np.float64), values


def _shown_grid(pipeline: App.DocumentObject) -> Any:
    """VTK's grid of the step that a pipeline shows, from what it writes into a document.

    Python gets at the data in no other way once a document was saved and opened.

    Raises:
        VolfrepError: there is none, or VTK is not installed for Python.
    """
    try:
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    except ImportError as error:
        raise VolfrepError(
            f"The FEM result '{pipeline.Label}' is read with the Python package vtk, which is not "
            "installed: run 'pip install vtk', or 'apt-get install python3-vtk9'."
        ) from error
    grids = _grids(bytes(pipeline.dumpPropertyContent("Data")))
    if not grids:
        raise VolfrepError(
            f"The FEM result '{pipeline.Label}' is empty: run the solver, or choose the "
            "CCX_Results that it was made of."
        )
    step = 0
    if hasattr(pipeline, "Frame"):
        step = pipeline.getEnumerationsOfProperty("Frame").index(pipeline.Frame)
    reader = vtkXMLUnstructuredGridReader()
    reader.ReadFromInputStringOn()
    reader.SetInputString(grids[min(step, len(grids) - 1)])
    reader.Update()
    return reader.GetOutput()


def _grids(content: bytes) -> list[bytes]:
    """The files of grids in a zip file, and in those that it holds, one for each step."""
    with zipfile.ZipFile(io.BytesIO(content)) as files:
        inner = [files.read(name) for name in files.namelist() if name.endswith(".zip")]
        names = [name for name in files.namelist() if name.endswith(".vtu")]
        names.sort(key=lambda name: [int(part) for part in re.findall(r"\d+", name)])
        own = [files.read(name) for name in names]
    return [grid for grid in own if grid] + [grid for file in inner for grid in _grids(file)]


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


def _values(result: App.DocumentObject, quantity: str, count: int, column: str) -> np.ndarray:
    """(count,) the quantity's values; count is that of the nodes."""
    offered = {
        name: getattr(result, name)
        for name in result.PropertiesList
        if result.getTypeIdOfProperty(name) == "App::PropertyFloatList"
    }
    filled = [name for name, values in offered.items() if len(values) == count]
    if quantity not in filled:
        choice = f"choose {', '.join(filled)} as {column}" if filled else "run the solver"
        raise VolfrepError(
            f"The FEM result '{result.Label}' has no number '{quantity}' at each of its {count} "
            f"nodes: {choice}."
        )
    return np.array(offered[quantity], np.float64)
