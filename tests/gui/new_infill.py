# SPDX-License-Identifier: LGPL-2.1-or-later
"""A box, a lattice in it, and the panel of a new infill: what most scripts begin with."""

import FreeCAD as App
from driving import (
    answer_panel,
    click,
    infills,
    look_at_all,
    panel,
    select,
    settle,
    toolbar_button,
    wait_until,
)


def boxed(name="Boxed"):
    """A document with a box, of 40 x 30 x 20 mm."""
    doc = App.newDocument(name)
    doc.UndoMode = 1
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 30, 20
    doc.recompute()
    look_at_all()
    return doc, box


def filled(name="Boxed", **values):
    """The same with a lattice in the box, which is hidden: document, box and infill.

    Args:
        name: of the document.
        values: of the infill's properties, other than those of all scripts.
    """
    from freecad_volfrep import make_lattice_infill

    doc, box = boxed(name)
    doc.openTransaction("Fill")
    lattice = {"CellSize": 10, "StrutRadius": 1, "ShellThickness": 1, **values}
    if "Deviation" not in values:
        lattice.setdefault("Resolution", 10)
    obj = make_lattice_infill(doc, box, **lattice)
    doc.recompute()
    doc.commitTransaction()
    box.Visibility = False
    look_at_all()
    return doc, box, obj


def opened(box):
    """The panel of a new infill of the box, and the infill."""
    select(box)
    click(toolbar_button("Lattice Infill"))
    wait_until(lambda: panel() is not None)
    settle()
    return infills(box.Document)[0]


def cancelled():
    """Cancel in the panel."""
    answer_panel("Cancel")
    wait_until(lambda: panel() is None)
