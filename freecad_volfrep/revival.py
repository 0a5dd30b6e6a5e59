# SPDX-License-Identifier: LGPL-2.1-or-later
"""Objects of ours that a file holds without their proxies come back to life.

A FreeCAD without this workbench opens a document with lattice infills, finds no class for them,
and saves it with proxies of None. Their properties and meshes are all there, but nothing follows a
new radius any more, and `Status` says what it said last. A damaged or a foreign proxy comes to the
same. So every document is looked through when it is opened and before it is recomputed.

Registered at FreeCAD's start: nothing here costs time before there is something to revive.
"""

from __future__ import annotations

from typing import Any

import FreeCAD as App

_TYPES = ("Mesh::FeaturePython", "App::FeaturePython")
#: Properties by which objects of our classes are known, whatever their proxies say.
_PROPERTIES = {
    "LatticeInfill": {"Fingerprint", "SchemaVersion", "StrutRadius", "Status"},
    "PrintCheck": {"Infill", "Process", "Findings", "OverhangShare"},
    "SlicerInfill": {"Follows", "BandDensities", "ToldDensities", "Facets"},
    "DesignStudy": {"Infill", "Vary", "Fill", "Refused", "Table"},
}

_watch: Watch | None = None


class Watch:
    """Hears from FreeCAD when a document may hold objects without their proxies.

    FreeCAD 0.20 tells Python of no end of reading a file; it makes the document active then. A
    document that is read because another one links to it is not made active, but recomputed.
    """

    def slotActivateDocument(self, doc: Any) -> None:  # noqa: N802
        """A document was opened, or made active: it and those that were opened with it."""
        for known in App.listDocuments().values():
            revive(known)

    def slotBeforeRecomputeDocument(self, doc: Any) -> None:  # noqa: N802
        """What changed meanwhile is to be computed."""
        revive(doc)


def watch_documents() -> None:
    """Look through every document that is opened from now on."""
    global _watch
    if _watch is None:
        _watch = Watch()
        App.addDocumentObserver(_watch)


def revive(doc: App.Document) -> list[App.DocumentObject]:
    """Give objects of ours their proxies back; returns those that had lost them.

    They are marked as touched, because their properties may have changed meanwhile: the next
    recompute finds out, and makes no new mesh where nothing has. So are infills whose results were
    of a wrong type, for which a new one is made.
    """
    if doc.Restoring:
        return []
    revived = []
    for obj in [obj for kind in _TYPES for obj in doc.findObjects(kind)]:
        names = set(obj.PropertiesList)
        name = next((name for name in _PROPERTIES if names >= _PROPERTIES[name]), None)
        if name is None:
            continue
        from . import features
        from .features.infill.lattice_infill import say_revived
        from .features.infill.properties import has_lost_results
        from .features.jobs.screen import revive_view

        kind, is_infill = getattr(features, name), name == "LatticeInfill"
        if is_infill and has_lost_results(obj):
            obj.touch()
        if isinstance(getattr(obj, "Proxy", None), kind):
            continue
        kind(obj)
        if is_infill:
            say_revived(obj)
        revive_view(obj)
        obj.touch()
        App.Console.PrintWarning(
            f"VOLFREP, {obj.Label}: saved by a FreeCAD without VOLFREP, or damaged; it is alive "
            "again, and the next recompute brings it up to date.\n"
        )
        revived.append(obj)
    return revived
