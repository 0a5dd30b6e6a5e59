# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an infill's struts carry as they were sized: kept in the document, to be shown again.

They are of the lattice that was sized, and of no other: once a value has changed on which that
depends, they are not shown. As long as the loads are those that it was sized for, they are what is
shown: the design as it was held to its limits, and as CalculiX has proved it. Solved anew it would
differ by some percent, because the skin's triangles follow the struts that it was sized with.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import numpy as np
from numpy.typing import NDArray

from freecad_volfrep.features.infill.freshness import fingerprint_of, is_of
from freecad_volfrep.translation import QT_TRANSLATE_NOOP
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
    obj.SizedFor = fingerprint_of(obj, *obj.Proxy.read(obj))
    obj.SizedLoads = digest_of(loads)


def sized_states(
    obj: App.DocumentObject,
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """What is kept, whether or not it is of the present values.

    Returns:
        (m, 2, 3) ends of the struts, mm; (m, 2) the values there by what they are called.
    """
    kept = np.array(obj.SizedStates, np.float64).reshape(-1, 2, _NUMBERS)
    return kept[..., :3], {name: kept[..., 3 + k] for k, name in enumerate(_KEPT)}


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
