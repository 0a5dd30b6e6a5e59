# SPDX-License-Identifier: LGPL-2.1-or-later
"""A box, and the panel of a new infill of it: what several scripts begin with."""

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


def boxed():
    """A document with a box."""
    doc = App.newDocument("Boxed")
    doc.UndoMode = 1
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 30, 20
    doc.recompute()
    look_at_all()
    return doc, box


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
