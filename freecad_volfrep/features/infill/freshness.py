# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether an infill's mesh is that of its present values: the one place that knows.

What a mesh was made of is kept beside it as a digest, its fingerprint.
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import numpy as np

from freecad_volfrep.sentences import report_line
from freecad_volfrep.translation import QT_TRANSLATE_NOOP
from volfrep.util.content import digest_of
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from volfrep import LatticeSpec
    from volfrep.mesh.triangle_mesh import TriangleMesh

#: Why a mesh is not that of the present values.
CHANGED = QT_TRANSLATE_NOOP(
    "VolfrepFreshness", "values or the solid have changed since it was made"
)
NOT_RECOMPUTED = QT_TRANSLATE_NOOP(
    "VolfrepFreshness", "what it is made of has changed and is not recomputed yet"
)
NO_SENSE = QT_TRANSLATE_NOOP("VolfrepFreshness", "its present values cannot be computed")
#: `Status` of an infill whose mesh a step that was undone has brought back.
STALE = "Out of date: values have changed since this mesh was made; recompute"
#: How many digits the fingerprint of an earlier release has.
_EARLIER_DIGITS = 64


def fingerprint_of(obj: App.DocumentObject, spec: LatticeSpec, solid: TriangleMesh) -> str:
    """A digest of all that a result's geometry depends on.

    Args:
        obj: the infill.
        spec: what `LatticeInfill.read` has found.
        solid: the same.
    """
    return digest_of(spec.shape_digest(), obj.Proxy.solid_identity(solid))


def is_of(kept: str, obj: App.DocumentObject, spec: LatticeSpec, solid: TriangleMesh) -> bool:
    """Whether a fingerprint that was kept is that of a specification and a solid.

    That of an earlier release counts as well, where it knew all that there is: so that documents
    which were saved with it are not computed again.

    Args:
        kept: the fingerprint.
        obj: the infill.
        spec: what `LatticeInfill.read` has found.
        solid: the same.
    """
    if len(kept) == _EARLIER_DIGITS:
        return kept == _earlier_fingerprint(spec, solid)
    return bool(kept) and kept == fingerprint_of(obj, spec, solid)


def why_stale(obj: App.DocumentObject) -> str:
    """Why the mesh of an infill is not that of its present values, in English; empty where it is.

    It is empty as well for what is no lattice infill, and for one without a mesh.
    """
    if not hasattr(getattr(obj, "Proxy", None), "solid_identity") or not obj.Fingerprint:
        return ""
    try:
        spec, solid = obj.Proxy.read(obj)
    except VolfrepError:
        return str(NO_SENSE)
    if not is_of(obj.Fingerprint, obj, spec, solid):
        return str(CHANGED)
    # What a shape comes to is not known before it is recomputed.
    behind = {"Touched", "Invalid"}
    if any(behind & set(other.State) for other in obj.OutListRecursive):
        return str(NOT_RECOMPUTED)
    return ""


def tell_stale(obj: App.DocumentObject) -> tuple[str, ...]:
    """The sentence that a result of a mesh that is out of date has to say; none where it is not.

    It is written to the report view, too.
    """
    why = why_stale(obj)
    if not why:
        return ()
    sentence = f"The mesh of '{obj.Label}' is out of date ({why}): recompute it for a present one."
    App.Console.PrintWarning(report_line(obj.Label, sentence))
    return (sentence,)


def _earlier_fingerprint(spec: LatticeSpec, solid: TriangleMesh) -> str | None:
    """The fingerprint as releases up to 0.1.0 made it; None where they did not look at all."""
    from volfrep.design.scattered_field import PointField

    content = spec.kind.content_of_0_1_0()
    if content is None:
        return None
    digest = hashlib.sha256()
    values: dict[str, Any] = spec.as_dict()
    density = values.pop("density")
    if spec.target is not None:
        values["target"] = spec.target, density if spec.target.aim == "mass" else None
    digest.update(repr(sorted(values.items())).encode())
    field = None if spec.radius_grading is None else spec.radius_grading.field
    if isinstance(field, PointField):
        digest.update(field.points.tobytes())
        digest.update(field.values.tobytes())
    for array in content:
        digest.update(array.tobytes())
    digest.update((np.round(solid.vertices, 6) + 0.0).tobytes())
    digest.update(np.ascontiguousarray(solid.triangles, np.int32).tobytes())
    return digest.hexdigest()
