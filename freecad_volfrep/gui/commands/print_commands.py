# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands for those who print: a slicer's infill, coupons, the build direction."""

from __future__ import annotations

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.bridge.solids import is_fillable, resolve_base
from freecad_volfrep.features.infill.lattice_infill import is_infill
from freecad_volfrep.gui.messages import errors_shown
from freecad_volfrep.gui.selection import (
    only_shown_solid,
    only_solid,
    selected_solids,
    wants,
    why_no_solid,
)
from freecad_volfrep.translation import translate


@wants(
    "Select one solid, with Ctrl a FEM result or sized lattice infill, or one slicer infill.",
    why_no_solid,
)
def solid_or_slicer_infill() -> App.DocumentObject | None:
    """The selected slicer infill; else the one solid that is selected, or the only one there is.

    A FEM result or a sized lattice may be selected with the solid, or alone: that of the lattice,
    or the only one that is shown, is meant then.
    """
    from freecad_volfrep.features import SlicerInfill

    selected = Gui.Selection.getSelection()
    if len(selected) == 1 and isinstance(getattr(selected[0], "Proxy", None), SlicerInfill):
        return selected[0]
    source, others = _source_and_others()
    if source is None:
        solids = selected_solids() or only_solid()
    elif others:
        solids = [resolve_base(one) for one in others if is_fillable(one)]
        solids = solids if len(others) == 1 else []
    elif is_infill(source):
        solids = [source.Base] if source.Base is not None else []
    else:
        solids = only_shown_solid()
    return solids[0] if len(solids) == 1 else None


def _source_and_others() -> tuple[App.DocumentObject | None, list[App.DocumentObject]]:
    """What is selected that a density can follow, if it is one; and the other objects."""
    from freecad_volfrep.features.export.slicer_infill import source_of

    selected = list(dict.fromkeys(Gui.Selection.getSelection()))
    sources = [one for one in selected if source_of(one)]
    if len(sources) != 1:
        return None, selected
    return sources[0], [one for one in selected if one is not sources[0]]


def slicer_infill(obj: App.DocumentObject) -> None:
    """Open the panel of a slicer infill; of a solid, make one first."""
    from freecad_volfrep.bridge.solids import SolidReader
    from freecad_volfrep.features import SlicerInfill
    from freecad_volfrep.features.export.slicer_infill import make_slicer_infill, source_of
    from freecad_volfrep.gui.printing.slicer_panel import SlicerPanel

    if isinstance(getattr(obj, "Proxy", None), SlicerInfill):
        Gui.getDocument(obj.Document.Name).setEdit(obj.Name)
        return
    source, _ = _source_and_others()
    doc = obj.Document
    doc.openTransaction(translate("VOLFREP_SlicerInfill", "Slicer Infill"))
    with errors_shown():
        low, high = SolidReader().read(obj, App.Placement()).bounds
        reach = max(1.0, float(f"{min(high - low) / 3.0:.1g}"))
        made = make_slicer_infill(doc, obj, Reach=reach)
        if source is not None:
            made.Follows, made.FieldObject = source_of(source), source
        Gui.Control.showDialog(SlicerPanel(made, is_new=True))
        return
    doc.abortTransaction()


def make_specimens(infill: App.DocumentObject) -> None:
    """Ask which coupons there are to be of an infill's lattice, and make them."""
    from freecad_volfrep.gui.printing.coupon_box import ask_and_make

    ask_and_make(infill)


def orient_part(obj: App.DocumentObject) -> None:
    """Open the panel of the directions in which a part is built best."""
    from freecad_volfrep.gui.printing.orient_panel import open_orientations

    open_orientations(obj)
