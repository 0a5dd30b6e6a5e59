# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a running job's progress goes: a window with Cancel, or nowhere without a screen."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import FreeCAD as App

from volfrep.progress import ProgressCallback


@contextmanager
def progress_of(title: str) -> Iterator[ProgressCallback | None]:
    """A callback for one job of that title; None in a FreeCAD without windows."""
    if not App.GuiUp:
        yield None
        return
    from freecad_volfrep.gui.progress import progress_dialog

    with progress_dialog(title) as callback:
        yield callback
