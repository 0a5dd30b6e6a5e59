# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands for those who print: a slicer's infill, coupons, the build direction."""

from __future__ import annotations

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.gui.messages import errors_shown
from freecad_volfrep.gui.selection import only_solid, selected_solids
from freecad_volfrep.translation import translate


def solid_or_slicer_infill() -> App.DocumentObject | None:
    """The selected slicer infill; else the one solid that is selected, or the only one there is."""
    from freecad_volfrep.features import SlicerInfill

    selected = Gui.Selection.getSelection()
    if len(selected) == 1 and isinstance(getattr(selected[0], "Proxy", None), SlicerInfill):
        return selected[0]
    solids = selected_solids() or only_solid()
    return solids[0] if len(solids) == 1 else None


def slicer_infill(obj: App.DocumentObject) -> None:
    """Open the panel of a slicer infill; of a solid, make one first."""
    from freecad_volfrep.bridge.solids import SolidReader
    from freecad_volfrep.features import SlicerInfill
    from freecad_volfrep.features.export.slicer_infill import make_slicer_infill
    from freecad_volfrep.gui.printing.slicer_panel import SlicerPanel

    if isinstance(getattr(obj, "Proxy", None), SlicerInfill):
        Gui.getDocument(obj.Document.Name).setEdit(obj.Name)
        return
    doc = obj.Document
    doc.openTransaction(translate("VOLFREP_SlicerInfill", "Slicer Infill"))
    with errors_shown():
        low, high = SolidReader().read(obj, App.Placement()).bounds
        reach = max(1.0, float(f"{min(high - low) / 3.0:.1g}"))
        made = make_slicer_infill(doc, obj, Reach=reach)
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
