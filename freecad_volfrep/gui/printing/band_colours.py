# SPDX-License-Identifier: LGPL-2.1-or-later
"""The colours of bands of density, in the view and in the panel."""

from __future__ import annotations

#: From sparse to dense (of ColorBrewer's YlOrRd, told apart in grey too).
COLOURS = ((1.0, 0.91, 0.55), (0.99, 0.70, 0.30), (0.95, 0.35, 0.18), (0.55, 0.0, 0.20))


def colours_of(count: int) -> list[tuple[float, float, float]]:
    """Of so many bands, the least dense first."""
    found = []
    for k in range(count):
        place = k / max(count - 1, 1) * (len(COLOURS) - 1)
        low = min(int(place), len(COLOURS) - 2)
        share = place - low
        red, green, blue = (
            (1.0 - share) * a + share * b
            for a, b in zip(COLOURS[low], COLOURS[low + 1], strict=True)
        )
        found.append((red, green, blue))
    return found
