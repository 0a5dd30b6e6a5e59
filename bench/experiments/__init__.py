# SPDX-License-Identifier: LGPL-2.1-or-later
"""A module an experiment: `measure` gives plain JSON values, `render` makes a chapter of them.

`measure(context)` returns a dictionary; its "bars" are the promises that the experiment decides,
and a row in it that is marked "failed" is a job of ours that did not work. `render(result, images)`
returns Markdown and puts its plots into the folder `images`.
"""

from __future__ import annotations

from types import ModuleType

from . import (
    accuracy,
    blocks,
    bracket,
    cells,
    limits,
    profiles,
    rod,
    scale,
    shares,
    sizes,
    startup,
    trimmed,
    wing,
)

#: In the order of the document.
EXPERIMENTS: dict[str, ModuleType] = {
    "startup": startup,
    "blocks": blocks,
    "accuracy": accuracy,
    "cells": cells,
    "bracket": bracket,
    "sizes": sizes,
    "trimmed": trimmed,
    "shares": shares,
    "limits": limits,
    "rod": rod,
    "wing": wing,
    "scale": scale,
    "profiles": profiles,
}
