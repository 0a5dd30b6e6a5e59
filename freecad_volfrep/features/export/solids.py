# SPDX-License-Identifier: LGPL-2.1-or-later
"""The shapes that a lattice infill can be made into, each with what it will take."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import FreeCAD as App

from freecad_volfrep.features.infill.lattice_infill import is_infill
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError, listed

from .exact import checked_ingredients, exact_shape, warn
from .faceted_solid import CURVED, acceptable_solid, make_solid, shape_object
from .instances import make_instances
from .solver_files import axes_of, estimate_file


@dataclass(frozen=True)
class Kind:
    """One kind of shape.

    Attributes:
        name: for scripts.
        title: for people.
        predict: what it will take, as a sentence; raises where it is refused.
        make: adds it to a document.
        of_any_mesh: whether any mesh object will do; the others want a lattice infill.
    """

    name: str
    title: str
    predict: Callable[[App.DocumentObject], str]
    make: Callable[[App.Document, App.DocumentObject], App.DocumentObject]
    of_any_mesh: bool = False


def make_exact_solid(doc: App.Document, obj: App.DocumentObject) -> App.DocumentObject:
    """Add a ``Part::Feature`` of cylinders, cones and spheres where the infill lies.

    Where OpenCASCADE does not manage it, the solid has plane faces and the report view says why.

    Raises:
        VolfrepError: it is no lattice infill with bare struts, or too large; or it can be neither
            exact nor faceted.
        Cancelled: in the window, by the user.
    """
    made_of = checked_ingredients(obj)
    try:
        shape = exact_shape(obj, made_of)
    except VolfrepError as error:
        solid = make_solid(doc, obj)
        warn(obj, (f"{error} The solid has plane faces instead of exact surfaces.",))
        return solid
    return shape_object(doc, obj, shape, CURVED)


def make_axes(doc: App.Document, obj: App.DocumentObject) -> App.DocumentObject:
    """Add a ``Part::Feature`` of the struts' axes, cut at the inner wall.

    Raises:
        VolfrepError: no strut lies inside.
        Cancelled: in the window, by the user.
    """
    import Part

    frame = axes_of(obj).wireframe
    ends = frame.nodes[frame.struts].tolist()
    axes = doc.addObject("Part::Feature", f"{obj.Name}Axes")
    axes.Label = translate("VolfrepLabels", "{label} axes").format(label=obj.Label)
    axes.Shape = Part.makeCompound([Part.makeLine(App.Vector(*a), App.Vector(*b)) for a, b in ends])
    axes.purgeTouched()
    return axes


#: In the order of the dialog's list.
KINDS = (
    Kind(
        "faceted",
        "One solid of plane faces",
        lambda obj: str(acceptable_solid(obj)),
        make_solid,
        True,
    ),
    Kind(
        "exact",
        "One solid of exact surfaces",
        lambda obj: estimate_file(obj, "exact"),
        make_exact_solid,
    ),
    Kind(
        "instances",
        "Links to one solid for each kind of joint",
        lambda obj: estimate_file(obj, "instances"),
        make_instances,
    ),
    Kind("axes", "Axes of the struts", lambda obj: estimate_file(obj, "wireframe"), make_axes),
)


def kinds_of(obj: App.DocumentObject) -> list[Kind]:
    """The kinds of shapes that this mesh object can be made into."""
    infill = is_infill(obj)
    return [kind for kind in KINDS if infill or kind.of_any_mesh]


def make_kind(doc: App.Document, obj: App.DocumentObject, name: str) -> App.DocumentObject:
    """Add the shape of that name to the document.

    Args:
        doc: the document to add it to.
        obj: a lattice infill; for ``faceted`` any closed mesh object.
        name: ``faceted``, ``exact``, ``instances`` or ``axes``.

    Raises:
        VolfrepError: there is no such kind, or it cannot be made; the text says why.
        Cancelled: in the window, by the user.
    """
    for kind in kinds_of(obj):
        if kind.name == name:
            return kind.make(doc, obj)
    names = listed([kind.name for kind in kinds_of(obj)])
    raise VolfrepError(f"'{obj.Label}' cannot be made into '{name}': choose {names}.")
