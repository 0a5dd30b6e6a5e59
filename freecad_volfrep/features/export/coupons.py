# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specimens of an infill's lattice, to print and measure, as mesh objects beside it or as files."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

import FreeCAD as App

from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from volfrep.jobs.coupons import Coupon

#: What holds a ladder's table, to be filled in; and between two specimens, mm.
TABLE, GAP = "PrintedTable", 10.0


def coupons_of(
    infill: App.DocumentObject, kinds: Sequence[str], cells: int = 4, first: int = 1
) -> list[Coupon]:
    """Specimens of the lattice that an infill's properties say, without its skin and its solid.

    Args:
        infill: a lattice infill.
        kinds: of `volfrep.jobs.coupons.KINDS`.
        cells: along the edge of the cube.
        first: number of the first one, in relief.

    Raises:
        VolfrepError: no kind is chosen, or the lattice has no specimens of it.
        Cancelled: in the window, by the user.
    """
    from volfrep.jobs.coupons import make_coupons

    if not kinds:
        raise VolfrepError("No coupon is chosen: tick at least one.")
    _, spec, _ = infill.Proxy.wanted(infill)
    title = job_title("Coupons of {label}", infill)
    made: list[Coupon] = run_job(title, make_coupons, spec, tuple(kinds), cells=cells, first=first)
    return made


def add_coupons(infill: App.DocumentObject, coupons: Sequence[Coupon]) -> App.DocumentObject:
    """Add specimens to the document in a group, side by side in front of the infill's solid.

    A ladder has its table to fill in, once it is measured, as a property.

    Returns:
        The group.
    """
    from freecad_volfrep.bridge.meshes import to_freecad

    doc, box = infill.Document, infill.Mesh.BoundBox
    group = doc.addObject("App::DocumentObjectGroup", "Coupons")
    group.Label = translate("VolfrepLabels", "{label} coupons").format(label=infill.Label)
    x, front = (box.XMin, box.YMin) if infill.Mesh.CountFacets else (0.0, 0.0)
    for coupon in coupons:
        low, high = coupon.mesh.bounds
        obj = doc.addObject("Mesh::Feature", f"Coupon{coupon.number}")
        obj.Label = f"{coupon.number} {coupon.kind}"
        obj.Mesh = to_freecad(coupon.mesh)
        obj.Placement.Base = App.Vector(x - low[0], front - GAP - high[1], -low[2])
        x += high[0] - low[0] + GAP
        sizes = ", ".join(f"{name} {value:g}" for name, value in coupon.sizes.items())
        obj.addProperty("App::PropertyString", "Sizes", "Coupon", "For the test's evaluation, mm")
        obj.Sizes = sizes
        if coupon.struts:
            obj.addProperty(
                "App::PropertyString", TABLE, "Coupon", "CSV whose last column is to be measured"
            )
            setattr(obj, TABLE, coupon.table())
        group.addObject(obj)
    return group


def write_coupons(coupons: Sequence[Coupon], folder: str | os.PathLike[str]) -> list[str]:
    """Write specimens as STL files into a folder, and a ladder's table beside them.

    Returns:
        The paths.

    Raises:
        VolfrepError: the folder cannot be made, or a file cannot be written.
    """
    from volfrep.output.meshes import write_mesh
    from volfrep.util.files import make_folder, replacing

    place, written = make_folder(folder), []
    for coupon in coupons:
        path = place / f"{coupon.number}_{coupon.kind}.stl"
        write_mesh(coupon.mesh, path)
        written.append(str(path))
        if coupon.struts:
            table = path.with_suffix(".csv")
            with replacing(table) as file:
                file.write(coupon.table().encode())
            written.append(str(table))
    return written
