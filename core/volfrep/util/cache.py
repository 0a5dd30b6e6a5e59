# SPDX-License-Identifier: LGPL-2.1-or-later
"""The results of the stages of a run, kept for the next one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

T = TypeVar("T")


@dataclass
class StageCache:
    """The last result of every stage, reused as long as what went into it is the same.

    Give the same cache to run after run: a new strut radius then repeats neither the shelling
    nor the voxelisation. It holds meshes; drop it to free them.
    """

    _entries: dict[str, tuple[Any, Any]] = field(default_factory=dict)

    def get(self, stage: str, key: object, compute: Callable[[], T]) -> T:
        """The stage's last value if it was made for an equal key, else a new one."""
        entry = self._entries.get(stage)
        if entry is not None and entry[0] == key:
            value: T = entry[1]
            return value
        value = compute()
        self._entries[stage] = (key, value)
        return value
