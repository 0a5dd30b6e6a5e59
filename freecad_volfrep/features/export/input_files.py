# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files that a document's objects are made of, which nothing that is written may replace."""

from __future__ import annotations

import os
from collections.abc import Iterable

import FreeCAD as App

from volfrep.util.files import refuse_overwriting


def files_read_by(objects: Iterable[App.DocumentObject]) -> dict[str, str]:
    """The files that objects, and all that they depend on, read; and their documents' own.

    Returns:
        Paths by what they are to a user, such as "CellFile of 'Infill'".
    """
    found: dict[str, str] = {}
    objects = list(objects)
    for obj in {one.Name: one for top in objects for one in (top, *top.OutListRecursive)}.values():
        for name in obj.PropertiesList:
            path = getattr(obj, name)
            if obj.getTypeIdOfProperty(name) == "App::PropertyFile" and path:
                found[f"{name} of '{obj.Label}'"] = path
    for document in {obj.Document.Name: obj.Document for obj in objects}.values():
        if document.FileName:
            found[f"document '{document.Label}'"] = document.FileName
    return found


def refuse_inputs(path: str | os.PathLike[str], *objects: App.DocumentObject) -> None:
    """Refuse to write over a file that the objects, or those they depend on, are made of.

    Raises:
        VolfrepError: naming the property, its object and the path.
    """
    refuse_overwriting({"output": path}, files_read_by(objects))


def refuse_inputs_of_all(path: str | os.PathLike[str], but: tuple[str, ...] = ()) -> None:
    """The same for every object of every open document, but for properties of some names."""
    objects = [obj for document in App.listDocuments().values() for obj in document.Objects]
    read = files_read_by(objects)
    kept = {what: file for what, file in read.items() if what.split(" of ")[0] not in but}
    refuse_overwriting({"output": path}, kept)
