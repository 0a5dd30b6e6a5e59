# SPDX-License-Identifier: LGPL-2.1-or-later
"""A binary STL that is begun before all of it is known: octants inside, while the rest is made.

The file is what `write_surface_stl` writes. It lies beside the target, as any unfinished one, until
it is whole; octants that are not beside the mesh in the end are written over.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import ExitStack, contextmanager
from threading import Event
from typing import BinaryIO

from ...trim.placed_lattice import InnerOctants
from ...trim.trimmed_surface import TrimmedSurface
from ...util.files import refuse_full, replacing
from ...util.progress import POLL_SECONDS, Monitor
from .stl import FACET, HEADER_BYTES, append_facets, mesh_blocks, refuse_too_many, write_head
from .stl_octants import filled_places, left_over, octant_copies, places_of, write_surface_stl


class _Discarded(Exception):
    """The file that was begun is not wanted."""


class StlAhead:
    """An STL file, of which octants are written by a thread as soon as they are known.

    Args:
        path: of the file; an old file stays if anything goes wrong.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = path
        self._begun: InnerOctants | None = None
        self._open = ExitStack()
        self._stop = Event()

    def begin(self, inner: InnerOctants) -> None:
        """Write octants, most of which will be beside the mesh of the surface, from now on.

        Raises:
            VolfrepError: the path cannot be written, or the disk is too full for them.
        """
        self.discard()
        size = HEADER_BYTES + 4 + FACET.itemsize * inner.layout.triangles
        self._file: BinaryIO = self._open.enter_context(replacing(self._path, size))
        self._begun, self._stop = inner, Event()
        pool = ThreadPoolExecutor(1, thread_name_prefix="volfrep")
        self._written: Future[None] = pool.submit(self._write, inner, self._file, self._stop)
        pool.shutdown(wait=False)

    def finish(self, surface: TrimmedSurface, monitor: Monitor | None = None) -> None:
        """Write the rest of a surface, in mm; the file is there then.

        Args:
            surface: as of `write_surface_stl`.
            monitor: told the progress, asked for a cancel.

        Raises:
            VolfrepError: as `write_surface_stl`.
            Cancelled: when the monitor says so; no file is left behind.
        """
        inner, begun = places_of(surface), self._begun
        if begun is None or inner is None or not _same(inner, begun):
            self.discard()
            write_surface_stl(surface, self._path, monitor)
            return
        with self._open.pop_all():
            try:
                self._end(surface, inner, monitor)
            finally:
                self._halt()

    def discard(self) -> None:
        """Take away what was begun."""
        if self._begun is None:
            return
        self._halt()
        try:
            with self._open.pop_all():
                raise _Discarded
        except _Discarded:
            return

    def _halt(self) -> None:
        """Let go of the file, before it is closed."""
        self._stop.set()
        wait([self._written])
        self._begun = None

    def _end(self, surface: TrimmedSurface, inner: InnerOctants, monitor: Monitor | None) -> None:
        file, count = self._file, surface.triangles
        refuse_too_many(count, self._path)
        while not self._written.done():
            wait([self._written], POLL_SECONDS)
            if monitor is not None:
                monitor.tick()
        self._written.result()
        head, octants = HEADER_BYTES + 4, inner.layout.triangles
        refuse_full(self._path, FACET.itemsize * (count - octants))
        file.seek(0)
        write_head(file, count)
        begin = head
        for copies, facets in filled_places(surface, inner, self._path):
            if facets is not copies.facets:
                file.seek(begin)
                file.write(facets().data)
            begin += FACET.itemsize * copies.each * len(copies.places)
        file.seek(begin)
        rest = mesh_blocks(surface.mesh, self._path, left_over(surface, inner))
        append_facets(file, rest, count, octants, monitor)

    def _write(self, inner: InnerOctants, file: BinaryIO, stop: Event) -> None:
        write_head(file, 0)
        for copies in octant_copies(inner, self._path):
            if stop.is_set():
                return
            file.write(copies.facets().data)


def _same(one: InnerOctants, other: InnerOctants) -> bool:
    return one.laid is other.laid and bool((one.where == other.where).all())


@contextmanager
def stl_ahead(path: str | os.PathLike[str]) -> Iterator[StlAhead]:
    """An STL file that may be begun within the block; what is not finished there goes."""
    ahead = StlAhead(path)
    try:
        yield ahead
    finally:
        ahead.discard()
