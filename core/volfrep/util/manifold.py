# SPDX-License-Identifier: LGPL-2.1-or-later
"""The one door to manifold3d, which some Pythons do not have.

Whatever needs its Booleans asks here, when it needs them, and says what for. Without it previews,
blocks, layers as pictures, beams, axes and decks are as ever, and most parts are made: their skin
has more facets. Open faces, drain holes, outlines of layers, bodies that overlap, and octants where
the seam cut is not certain need it.
"""

from __future__ import annotations

import importlib.util
import os
import sys
from typing import Any

from .packages import package

#: Names the command that installs it where the Python that runs is not the one to ask: the
#: workbench sets it, and the processes that it starts have it from there.
INSTALL = "VOLFREP_INSTALL_MANIFOLD3D"


def has_manifold() -> bool:
    """Whether manifold3d is there, without importing it."""
    if "manifold3d" in sys.modules:
        return sys.modules["manifold3d"] is not None
    return importlib.util.find_spec("manifold3d") is not None


def manifold_library(purpose: str) -> Any:
    """The module manifold3d.

    Args:
        purpose: what needs it, as the subject of a sentence: "Uniting overlapping bodies".

    Raises:
        MissingPackage: it is not there; the text says how to get it.
    """
    return package("manifold3d", purpose, install_command())


def install_command() -> str:
    """What installs manifold3d for this Python, as a command for a shell."""
    return os.environ.get(INSTALL) or f"{sys.executable} -m pip install manifold3d"
