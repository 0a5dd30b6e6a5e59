# SPDX-License-Identifier: LGPL-2.1-or-later
"""The preview of a lattice infill: what its present properties would make, at once."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.translation import translate

if TYPE_CHECKING:
    from volfrep.design.forecast import Forecast
    from volfrep.jobs.preview import Preview
    from volfrep.mesh.triangle_mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class Shown:
    """What is shown while values change.

    Attributes:
        solid: in the coordinates of the infill's group.
        preview: the struts and their figures.
        forecast: what computing it comes to.
    """

    solid: TriangleMesh
    preview: Preview
    forecast: Forecast

    @property
    def text(self) -> str:
        """The figures as lines for a user."""
        p, f = self.preview, self.forecast
        return translate(
            "VolfrepFigures",
            "{cells:,} active cells, {struts:,} struts\n"
            "relative density {density:.3g} %, mass {mass:.4g} g\n"
            "about {triangles:.2g} million triangles, {size:.2g} MB as STL, "
            "{seconds:.2g} s to compute",
        ).format(
            cells=p.cells,
            struts=p.struts,
            density=100 * p.relative_density,
            mass=p.mass,
            triangles=f.triangles / 1e6,
            size=f.stl_mb,
            seconds=max(1.0, f.seconds),
        )


class LivePreview:
    """Makes previews of one infill; what depends on its solid alone is kept between them."""

    def __init__(self, obj: App.DocumentObject) -> None:
        self._obj = obj
        self._key = b""
        self._known: Any = None

    def show(self) -> Shown:
        """The preview of the object's present properties.

        Raises:
            VolfrepError: they make no sense, or do not fit the solid.
        """
        from volfrep.design.forecast import forecast_fill
        from volfrep.io.solid import check_solid
        from volfrep.jobs.preview import PartDepth, preview

        spec, mesh = self._obj.Proxy.read(self._obj)
        key = hashlib.blake2b(mesh.vertices.tobytes() + mesh.triangles.tobytes())
        key.update(repr(spec.as_dict()["open_faces"]).encode())
        if self._key != key.digest():
            solid = check_solid(mesh, self._obj.Base.Label)
            self._known = solid, PartDepth(solid, spec.open_faces)
            self._key = key.digest()
        solid, depth = self._known
        return Shown(solid, preview(solid, spec, depth), forecast_fill(solid, spec))
