# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is selected, as the commands need it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate

_Find = TypeVar("_Find", bound=Any)

#: Of what is selected and has surfaces only, by whether these are closed.
_OPEN = QT_TRANSLATE_NOOP(
    "VolfrepCommands",
    "'{label}' is an open surface, which encloses nothing: close it or give it a thickness, and "
    "convert it to a solid (Part > Convert to solid).",
)
_CLOSED = QT_TRANSLATE_NOOP(
    "VolfrepCommands",
    "'{label}' is a closed surface and not a solid yet: convert it (Part > Convert to solid).",
)


def wants(text: str, explain: Callable[[], str] = str) -> Callable[[_Find], _Find]:
    """Say with a function below what it looks for, to who has not selected it.

    Args:
        text: a sentence, which ``make translations`` looks for.
        explain: in its place, what is wrong with what is selected; empty for nothing.
    """

    def said(find: _Find) -> _Find:
        find.why_not = lambda: explain() or str(translate("VolfrepCommands", text))
        return find

    return said


def why_no_solid() -> str:
    """Why what is selected is nothing to fill, where that is a surface; else empty."""
    from freecad_volfrep.bridge.solids import surface_of

    for obj in Gui.Selection.getSelection():
        surface = surface_of(obj)
        if surface is not None:
            text = _CLOSED if surface.isClosed() else _OPEN
            return str(translate("VolfrepCommands", text).format(label=obj.Label))
    return ""


def selected_solids() -> list[App.DocumentObject]:
    """The selected objects, each once, if every one of them can be filled; else none."""
    from freecad_volfrep.bridge.solids import is_fillable, resolve_base

    selected = [resolve_base(obj) for obj in Gui.Selection.getSelection()]
    if not all(is_fillable(obj) for obj in selected):
        return []
    return list(dict.fromkeys(selected))


def only_solid() -> list[App.DocumentObject]:
    """The one solid that is shown, where nothing is selected and there is no other; else none."""
    return [] if Gui.Selection.getSelection() else only_shown_solid()


def only_shown_solid() -> list[App.DocumentObject]:
    """The one solid that is shown, where there is no other; else none."""
    from freecad_volfrep.bridge.solids import is_fillable, resolve_base
    from freecad_volfrep.features import LatticeInfill, PrintCheck, SlicerInfill

    if App.ActiveDocument is None:
        return []
    found: dict[App.DocumentObject, None] = {}
    for obj in App.ActiveDocument.Objects:
        proxy = getattr(obj, "Proxy", None)
        is_ours = isinstance(proxy, (LatticeInfill, PrintCheck, SlicerInfill))
        if obj.Visibility and not is_ours and is_fillable(obj):
            found[resolve_base(obj)] = None
            if len(found) > 1:
                return []
    return list(found)


@wants("Select one lattice infill that is computed, or one mesh.")
def selected_mesh() -> App.DocumentObject | None:
    """The selected mesh object, if it is the only selection and not empty."""
    selected = Gui.Selection.getSelection()
    if len(selected) != 1 or not selected[0].isDerivedFrom("Mesh::Feature"):
        return None
    return selected[0] if selected[0].Mesh.CountFacets else None


@wants("Select one lattice infill and, with Ctrl, faces of its solid.")
def selected_infill_and_faces() -> (
    tuple[App.DocumentObject, list[tuple[App.DocumentObject, tuple[str, ...]]]] | None
):
    """One lattice infill and the faces of other objects, if nothing else is selected."""
    from freecad_volfrep.features.infill.lattice_infill import is_infill

    infills, faces = [], []
    for item in Gui.Selection.getSelectionEx():
        if is_infill(item.Object):
            infills.append(item.Object)
        elif item.SubElementNames and all(n.startswith("Face") for n in item.SubElementNames):
            faces.append((item.Object, tuple(item.SubElementNames)))
        else:
            return None
    return (infills[0], faces) if len(infills) == 1 and faces else None


@wants("Select one lattice infill.")
def selected_infill() -> App.DocumentObject | None:
    """The selected lattice infill, if it is the only selection."""
    from freecad_volfrep.features.infill.lattice_infill import is_infill

    found = selected_infill_or_study()
    return found if found is not None and is_infill(found) else None


@wants("Select one lattice infill or one design study.")
def selected_infill_or_study() -> App.DocumentObject | None:
    """The selected lattice infill or design study, if it is the only selection."""
    from freecad_volfrep.features import DesignStudy, LatticeInfill

    selected = Gui.Selection.getSelection()
    kinds = (LatticeInfill, DesignStudy)
    if len(selected) != 1 or not isinstance(getattr(selected[0], "Proxy", None), kinds):
        return None
    return selected[0]


def selected_with_edges() -> list[App.DocumentObject] | None:
    """The selected sketches, wires and shapes, each once, if every one of them has edges."""
    from freecad_volfrep.bridge.drawn_lines import has_edges

    selected = list(dict.fromkeys(Gui.Selection.getSelection()))
    return selected if selected and all(map(has_edges, selected)) else None


@wants("There is no lattice infill in this document: make one first.")
def selected_or_all_infills() -> list[App.DocumentObject] | None:
    """The selected lattice infills, or all of the document's where none is selected."""
    from freecad_volfrep.features.reports.statistics import infills_of

    if App.ActiveDocument is None:
        return None
    known = infills_of(App.ActiveDocument)
    selected = [obj for obj in Gui.Selection.getSelection() if obj in known]
    return selected or known or None


@wants("Select one lattice infill that has a solid, with its 3D view in front.")
def infill_in_view() -> App.DocumentObject | None:
    """The selected lattice infill, if a 3D view is in front that it can be shown in."""
    infill = selected_infill()
    if infill is None or infill.Base is None:
        return None
    view = Gui.activeDocument().activeView()
    return infill if hasattr(view, "getSceneGraph") else None


@wants(
    "Select one lattice infill that has a solid, or one solid, with its 3D view in front.",
    why_no_solid,
)
def infill_or_solid_in_view() -> App.DocumentObject | None:
    """The same, or one solid that can be filled: the selected one or the only one there is."""
    view = None if Gui.activeDocument() is None else Gui.activeDocument().activeView()
    if not hasattr(view, "getSceneGraph"):
        return None
    if selected_infill() is not None:
        return infill_in_view()
    solids = selected_solids() or only_solid()
    return solids[0] if len(solids) == 1 else None


@wants("Select one lattice infill that is computed, with its 3D view in front.")
def infill_with_mesh() -> App.DocumentObject | None:
    """The same, if it has a mesh."""
    infill = infill_in_view()
    return infill if infill is not None and infill.Mesh.CountFacets else None
