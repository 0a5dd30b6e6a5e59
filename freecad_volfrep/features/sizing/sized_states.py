# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an infill's struts carry as they were sized: kept in the document, to be shown again.

They are of the lattice that was sized, and of no other: once a value has changed on which that
depends, they are not shown. As long as the loads are those that it was sized for, they are what is
shown: the design as it was held to its limits, and as CalculiX has proved it. Solved anew it would
differ by some percent, because the skin's triangles follow the struts that it was sized with.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import numpy as np
from numpy.typing import NDArray

from freecad_volfrep.features.infill.freshness import fingerprint_of, is_of
from freecad_volfrep.features.infill.sized_radii import sized_skin
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, marked, translate
from volfrep.util.content import digest_of
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from volfrep.loads.load_cases import LoadCases
    from volfrep.sizing.strut_state import StrutState

#: Why there is nothing to show.
NOT_SIZED = QT_TRANSLATE_NOOP(
    "VolfrepColours", "No stresses are kept in the document: Loads and Sizing puts them there."
)
CHANGED = QT_TRANSLATE_NOOP(
    "VolfrepColours", "The lattice is not the one that was sized any more: size it again."
)
NO_LIMITS = QT_TRANSLATE_NOOP(
    "VolfrepColours", "What governs is not kept in the document: Loads and Sizing puts it there."
)
NO_SKIN = QT_TRANSLATE_NOOP(
    "VolfrepColours", "The skin was not sized: Loads and Sizing does that with a thinnest skin."
)
#: What may govern, marked for translation: limits and bounds of `volfrep.jobs.sizing.governing`.
LIMIT_NAMES = marked(
    "VolfrepSizePanel", "stress", "displacement", "buckling", "frame buckling", "frequency",
    "skin stress", "smallest radius", "largest radius", "smallest thickness", "largest thickness",
    "stiffness", "thickened with others", "one radius for all",
)  # fmt: skip
#: Of an end of a strut: its place, and the largest of all load cases, by the names of
#: `volfrep.jobs.figures.point_values.OF_LOADS`.
_KEPT = ("Stress", "Buckling", "Displacement")
_NUMBERS = 3 + len(_KEPT)


def store_states(obj: App.DocumentObject, states: Sequence[StrutState], loads: LoadCases) -> None:
    """Keep what an infill's struts carry, whose radii were stored before.

    Args:
        obj: the infill.
        states: its struts in each load case, in the coordinates of the infill's group.
        loads: what they were sized for.

    Raises:
        VolfrepError: a property of the infill makes no sense.
    """
    from volfrep.jobs.figures.point_values import OF_LOADS

    most = [np.max([state.values(OF_LOADS[name]) for state in states], axis=0) for name in _KEPT]
    kept = np.concatenate([states[0].ends, np.stack(most, axis=2)], axis=2)
    # In single precision, whose zeros a file of FreeCAD's packs to half the size.
    obj.SizedStates = kept.astype(np.float32).ravel().tolist()
    governing = states[0].governing
    assert governing is not None
    obj.SizedLimits = governing[:, 0].astype(int).tolist()
    obj.SizedFor = fingerprint_of(obj, *obj.Proxy.read(obj))
    obj.SizedLoads = digest_of(loads)


def sized_states(
    obj: App.DocumentObject,
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """What is kept, whether or not it is of the present values.

    Returns:
        (m, 2, 3) ends of the struts, mm; (m, 2) the values there by what they are called.
    """
    from volfrep.jobs.figures.point_values import GOVERNING

    kept = np.array(obj.SizedStates, np.float64).reshape(-1, 2, _NUMBERS)
    values = {name: kept[..., 3 + k] for k, name in enumerate(_KEPT)}
    if len(obj.SizedLimits) == len(kept):  # earlier releases kept none
        values[GOVERNING[0]] = np.repeat(np.array(obj.SizedLimits, float)[:, None], 2, axis=1)
    return kept[..., :3], values


def limits_of(
    obj: App.DocumentObject, quantity: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where something governs, and the row of that: of struts' ends, or of the skin's points.

    Args:
        obj: the infill.
        quantity: one of `volfrep.jobs.figures.point_values.GOVERNING`.

    Raises:
        VolfrepError: it is not kept, or is of other values.
    """
    why = why_no_limits(obj, quantity)
    if why:
        raise VolfrepError(why)
    ends, values = sized_states(obj)
    if quantity in values:
        return ends, values[quantity]
    skin = sized_skin(obj)
    assert skin is not None
    return skin.points, np.array(obj.SizedSkinLimits, float)


def limit_names(obj: App.DocumentObject, quantity: str) -> tuple[str, ...]:
    """What governs by its row, in the user's language; empty for a quantity that is a number."""
    from volfrep.jobs.figures.point_values import GOVERNING

    if quantity not in GOVERNING or not obj.SizingReport:
        return ()
    report = json.loads(obj.SizingReport)
    rows = report if quantity == GOVERNING[0] else report.get("skin", {})
    return names_of_limits((row["what"], row["case"]) for row in rows.get("governed_by", ()))


def names_of_limits(limits: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """Limits with their load cases, in the user's language."""
    return tuple(
        f"{translate('VolfrepSizePanel', what)}{', ' * bool(case)}{case}" for what, case in limits
    )


def why_no_limits(obj: App.DocumentObject, quantity: str) -> str:
    """Why it is not known what governs, in English; empty where it is."""
    from volfrep.jobs.figures.point_values import GOVERNING

    why = why_no_states(obj)
    if why:
        return why
    if quantity == GOVERNING[0]:
        return "" if quantity in sized_states(obj)[1] else str(NO_LIMITS)
    skin = sized_skin(obj)
    if skin is None:
        return str(NO_SKIN)
    return "" if len(skin.points) == len(obj.SizedSkinLimits) else str(NO_LIMITS)


def why_no_states(obj: App.DocumentObject) -> str:
    """Why what is kept is not of the present values, in English; empty where it is."""
    if not obj.SizedStates:
        return str(NOT_SIZED)
    try:
        values: Any = obj.Proxy.read(obj)
    except VolfrepError:
        return str(CHANGED)
    return "" if is_of(obj.SizedFor, obj, *values) else str(CHANGED)


def is_sized_for(obj: App.DocumentObject, loads: LoadCases) -> bool:
    """Whether what is kept is of the present values and of these loads."""
    return obj.SizedLoads == digest_of(loads) and not why_no_states(obj)
