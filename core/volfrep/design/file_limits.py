# SPDX-License-Identifier: LGPL-2.1-or-later
"""How large a file may be: numbers of the user's, or of a service. Read without numpy."""

from __future__ import annotations

from dataclasses import dataclass

from ..util.errors import VolfrepError, brief
from ..util.numbers import number, whole


@dataclass(frozen=True)
class FileLimits:
    """The most that a file of a mesh may hold; None for as much as it takes.

    Attributes:
        triangles: in it.
        megabytes: its size, in millions of bytes.
    """

    triangles: int | None = None
    megabytes: float | None = None

    def __post_init__(self) -> None:
        if self.triangles is not None:
            whole("most triangles of a file", self.triangles, 100, 10**10)
        if self.megabytes is not None:
            number("largest size of a file", self.megabytes, "", positive=True)

    def __bool__(self) -> bool:
        return self.triangles is not None or self.megabytes is not None

    def __str__(self) -> str:
        limits = []
        if self.triangles is not None:
            limits.append(f"{self.triangles:,} triangles")
        if self.megabytes is not None:
            limits.append(f"{self.megabytes:g} MB")
        return " and ".join(limits)


@dataclass(frozen=True)
class Service:
    """What a service takes.

    Attributes:
        name: of it.
        limits: of a file.
        source: that says so.
        read: when that was read; it may have changed since.
    """

    name: str
    limits: FileLimits
    source: str
    read: str


SERVICES = {
    row.name.lower(): row
    for row in (
        Service("Shapeways", FileLimits(1_000_000, 64.0),
                "support.shapeways.com, 3D printing checklist (360008357773)", "2026-11"),
        Service("Artrovo", FileLimits(1_000_000, 100.0),
                "prints.artrovogundam.com/design-guide (more triangles cost time)", "2026-11"),
        Service("Ponoko", FileLimits(None, 20.0),
                "www.ponoko.com/starter-kits/design-rules-3d", "2026-11"),
    )
}  # fmt: skip


def limits_of(service: str | None, triangles: int | None, megabytes: float | None) -> FileLimits:
    """The limits of a service, with the user's own in place of some of them.

    Raises:
        VolfrepError: there is no such service in the table, or a number makes no sense.

    >>> str(limits_of("Shapeways", None, 20.0))
    '1,000,000 triangles and 20 MB'
    """
    found = FileLimits()
    if service is not None:
        known = SERVICES.get(service.lower()) if isinstance(service, str) else None
        if known is None:
            names = ", ".join(row.name for row in SERVICES.values())
            raise VolfrepError(
                f"The limits of {brief(service)} are not known: choose {names}, or give the most "
                "triangles and megabytes."
            )
        found = known.limits
    return FileLimits(
        found.triangles if triangles is None else triangles,
        found.megabytes if megabytes is None else megabytes,
    )
