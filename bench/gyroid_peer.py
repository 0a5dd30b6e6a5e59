# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block of 10 x 10 x 10 gyroids into an STL, as scikit-image's marching cubes makes it.

One period is sampled at a thirtieth of a cell, closed where it lies at the block's outside, meshed
and copied: 27 kinds of cells, unwelded. To be timed, process start to file, beside
``volfrep block --cell Gyroid --cell-size 10 --wall-thickness 1 --resolution 30 --count 10,10,10``:

    python bench/gyroid_peer.py sheet FILE.stl
    python bench/gyroid_peer.py skeleton FILE.stl
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray
from skimage.measure import marching_cubes

STEPS, CELLS, SIZE, THICKNESS = 30, 10, 10.0, 1.0
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def samples(kind: str) -> NDArray[np.float64]:
    """(31, 31, 31) values over a period, negative where it is solid; of a sheet about mm."""
    angle = np.arange(STEPS + 1) * (2.0 * np.pi / STEPS)
    x, y, z = np.meshgrid(angle, angle, angle, indexing="ij", sparse=True)
    value = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
    if kind == "skeleton":
        return np.asarray(value)
    slope = np.sqrt(
        (np.cos(x) * np.cos(y) - np.sin(z) * np.sin(x)) ** 2
        + (np.cos(y) * np.cos(z) - np.sin(x) * np.sin(y)) ** 2
        + (np.cos(z) * np.cos(x) - np.sin(y) * np.sin(z)) ** 2
    )
    away = np.abs(value) / np.maximum(slope, 1e-6) * SIZE / (2.0 * np.pi)
    return np.asarray(away - 0.5 * THICKNESS)


def facets(value: NDArray[np.float64], low: int, high: int) -> NDArray[np.void]:
    """A cell's facets, closed on the sides whose bits are set."""
    sides = [(low >> k & 1, high >> k & 1) for k in range(3)]
    found: Any = marching_cubes(np.pad(value, sides, constant_values=1e6), 0.0)  # type: ignore[no-untyped-call]
    places = np.clip(found[0] - [side[0] for side in sides], 0, STEPS) * (SIZE / STEPS)
    corners = places.astype(np.float32)[found[1]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    keep = length > 0.0
    made = np.zeros(int(keep.sum()), FACET)
    made["corners"], made["normal"] = corners[keep], normal[keep] / length[keep, None]
    return made


def main() -> None:
    """Write the block."""
    kind, path = sys.argv[1:]
    value = samples(kind)
    cells = np.stack(np.meshgrid(*[np.arange(CELLS)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    bits = np.array([1, 2, 4])
    low, high = ((cells == 0) * bits).sum(axis=1), ((cells == CELLS - 1) * bits).sum(axis=1)
    made = [
        (facets(value, one, two), cells[(low == one) & (high == two)])
        for one, two in sorted(set(zip(low.tolist(), high.tolist(), strict=True)))
    ]
    count = sum(len(kind) * len(places) for kind, places in made)
    with open(path, "wb") as file:
        file.write(bytes(80) + np.uint32(count).tobytes())
        for pattern, places in made:
            for place in places:
                copy = pattern.copy()
                copy["corners"] += (place * SIZE).astype(np.float32)
                file.write(copy.tobytes())
    print(f"{count:,} triangles")


if __name__ == "__main__":
    main()
