# SPDX-License-Identifier: LGPL-2.1-or-later
"""What values hold, as something that can be compared: equal content, equal key."""

from __future__ import annotations

import hashlib
import math
import numbers
import struct
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any, TypeVar

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


def freeze(values: ArrayLike, dtype: type[Scalar]) -> NDArray[Scalar]:
    """A copy of an array that nobody can change any more."""
    result = np.array(values, dtype)
    result.flags.writeable = False
    return result


def rough(value: float) -> str:
    """A number to six digits, for a digest that rounding errors are not to change.

    Times pi, because numbers that people choose lie where these digits change.
    """
    return f"{value * math.pi:.5e}"


def digest_of(*values: object) -> str:
    """32 hexadecimal digits that tell values from others by all that they hold.

    They are the same in every process, on every machine and in every version of Python, so they
    may be kept in files. Values that are equal have equal digests.

    Args:
        values: None, numbers, texts, bytes, arrays, dataclasses, and sequences and mappings of
            such. Of a dataclass the fields count that its `==` compares, and of these the ones
            that differ from their defaults: a field that is added later changes no digest that is
            kept. So a default may not change its meaning. Where a class has a method `identity`,
            what that returns counts in place of the fields.

    Raises:
        TypeError: a value of another kind, of which nobody knows what it holds.

    >>> digest_of(1, "a") == digest_of(1.0, "a"), digest_of("ab") == digest_of("a", "b")
    (True, False)
    """
    digest = hashlib.blake2b(digest_size=16)
    for piece in _pieces(values):
        digest.update(piece)
    return digest.hexdigest()


def _pieces(value: Any) -> Iterator[bytes]:
    """What tells a value from others, in pieces of which none can be taken for another."""
    if value is None:
        yield b"-"
    elif isinstance(value, (numbers.Real, np.bool_)):
        yield b"n" + struct.pack(">d", float(value) + 0.0)  # which turns -0 to 0
    elif isinstance(value, str):
        yield from _sized(b"s", value.encode("utf-8", "surrogatepass"))
    elif isinstance(value, bytes):
        yield from _sized(b"b", value)
    elif isinstance(value, np.ndarray):
        yield b"a" + content_of(value)
    elif isinstance(value, (tuple, list)):
        yield b"(" + struct.pack(">q", len(value))
        for item in value:
            yield from _pieces(item)
    elif isinstance(value, Mapping):
        yield b"{" + struct.pack(">q", len(value))
        for name in sorted(value):
            yield from _pieces((name, value[name]))
    elif is_dataclass(value) and not isinstance(value, type):
        yield from _sized(b"d", type(value).__name__.encode())
        if hasattr(value, "identity"):
            yield from _pieces(value.identity())
        else:
            given = ((item, getattr(value, item.name)) for item in fields(value) if item.compare)
            yield from _pieces({item.name: one for item, one in given if _says(item, one)})
    else:
        raise TypeError(f"A {type(value).__name__} has no digest.")


def _sized(kind: bytes, content: bytes) -> Iterator[bytes]:
    yield kind + struct.pack(">q", len(content))
    yield content


def _says(item: Field[Any], value: Any) -> bool:
    """Whether a field has another value than its default."""
    default = item.default if item.default_factory is MISSING else item.default_factory()
    if hasattr(value, "identity"):
        return default is MISSING or digest_of(value) != digest_of(default)
    return default is MISSING or bool(value != default)
