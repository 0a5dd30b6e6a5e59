# SPDX-License-Identifier: LGPL-2.1-or-later
"""What arrays hold, as something that can be compared: equal content, equal key."""

from __future__ import annotations

import hashlib
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

Scalar = TypeVar("Scalar", bound=np.generic)


def content_of(*arrays: NDArray[np.generic]) -> bytes:
    """16 bytes that tell arrays from others by their types, shapes and values."""
    digest = hashlib.blake2b(digest_size=16)
    for array in arrays:
        digest.update(f"{array.dtype.str}{array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.digest()


def held(values: ArrayLike, dtype: type[Scalar]) -> NDArray[Scalar]:
    """A copy of an array that nobody can change any more."""
    result = np.array(values, dtype)
    result.flags.writeable = False
    return result
