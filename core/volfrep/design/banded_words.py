# SPDX-License-Identifier: LGPL-2.1-or-later
"""The words of a slicer's banded infill, which the command lists without numpy."""

from __future__ import annotations

#: What the density may follow.
GRADINGS = ("skin", "core", "direction", "field", "formula")
#: Patterns that PrusaSlicer, OrcaSlicer and Bambu Studio know by these names, and that lay about
#: what they are told (`jobs.slicer_infill.LAID`).
PATTERNS = ("gyroid", "cubic", "grid", "triangles", "line")
#: Layouts of projects: PrusaSlicer's; OrcaSlicer's and Bambu Studio's.
SLICERS = ("prusa", "orca")
