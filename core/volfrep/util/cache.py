# SPDX-License-Identifier: LGPL-2.1-or-later
"""The results of the stages of a run, kept for the next one.

A stage's key is the very inputs that its function is given: the function sees nothing else, so that
a dependency cannot be forgotten in a list. A mesh counts by its fingerprint, an earlier stage by
its own key, a part of the specification by its content.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Kept(Generic[T]):
    """A value, and what tells it from others where it cannot be compared itself.

    Attributes:
        value: such as a mesh, or the result of a stage.
        key: compared in its stead; of a stage's result, the stage and all that went into it.
    """

    value: T
    key: object


@dataclass
class StageCache:
    """The last result of every stage, reused as long as what went into it is the same.

    Give the same cache to run after run: a new strut radius then repeats neither the shelling
    nor the voxelisation. It holds meshes; drop it to free them.

    >>> cache = StageCache()
    >>> def squared(x):
    ...     print("squaring", x)
    ...     return x * x
    >>> [cache.run("square", squared, x).value for x in (3, 3, 4)]
    squaring 3
    squaring 4
    [9, 9, 16]
    """

    _entries: dict[str, tuple[Any, Any]] = field(default_factory=dict)

    def run(self, stage: str, function: Callable[..., T], *inputs: object) -> Kept[T]:
        """The stage's last value if it was made of equal inputs, else a new one.

        Args:
            stage: its name.
            function: makes the value; it sees the inputs and nothing else that matters.
            inputs: values that are compared, such as parts of a specification; or `Kept`, of
                which the key is compared and the value given to the function.
        """
        keys = tuple(value.key if isinstance(value, Kept) else value for value in inputs)
        entry = self._entries.get(stage)
        if entry is None or entry[0] != keys:
            given = (value.value if isinstance(value, Kept) else value for value in inputs)
            entry = keys, function(*given)
            self._entries[stage] = entry
        value: T = entry[1]
        return Kept(value, (stage, keys))
