# SPDX-License-Identifier: LGPL-2.1-or-later
"""A load step behind a deck of ours, which leaves that to its user: to solve it beside a model."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from volfrep.fem.deck import number_lines
from volfrep.fem.joint_loads import Ball
from volfrep.util.text_rows import rows
from volfrep.util.types import Floats, Ints


@dataclass(frozen=True, eq=False)
class StaticStep:
    """One linear static step: some nodes held, a force shared by others.

    Attributes:
        fixed: rows of the nodes that neither move nor turn.
        loaded: rows of the nodes that carry the force.
        force: (3,) the whole force, N.
        shares: (loaded,) what part of it each loaded node carries; None for equal parts.
    """

    fixed: Ints
    loaded: Ints
    force: tuple[float, float, float]
    shares: Floats | None = None

    def add_to(self, deck: Path, *, of_beams: bool) -> None:
        """Write it behind a deck of beams, whose nodes turn, or of solid elements."""
        with deck.open("ab") as file:
            file.writelines(self._lines(of_beams))

    def _lines(self, of_beams: bool) -> Iterator[bytes]:
        yield b"*NSET,NSET=FIXED\n"
        yield from number_lines(self.fixed)
        yield b"*NSET,NSET=LOADED\n"
        yield from number_lines(self.loaded)
        yield f"*BOUNDARY\nFIXED,1,{6 if of_beams else 3}\n*STEP\n*STATIC\n*CLOAD\n".encode()
        for axis, force in enumerate(self.force, 1):
            if force and self.shares is not None:
                yield from rows(f"%d,{axis},%.12g\n", self.loaded + 1, force * self.shares)
            elif force:
                yield f"LOADED,{axis},{force / len(self.loaded):.12g}\n".encode()
        forces = b"*NODE FILE,OUTPUT=2D\nU\n*EL FILE,SECTION FORCES\nS\n"
        yield b"*NODE PRINT,NSET=NALL\nU\n"
        yield forces if of_beams else b"*NODE FILE\nU\n*EL FILE\nS\n"
        yield b"*END STEP\n"


def joint_step(
    fixed: list[Ball], loaded: list[Ball], force: tuple[float, float, float]
) -> StaticStep:
    """A step that holds some joints; others share a force equally.

    Args:
        fixed: joints that are held.
        loaded: joints that carry the force.
        force: (3,) N, the whole of it.
    """
    return StaticStep(
        np.unique(np.concatenate([ball.nodes for ball in fixed])),
        np.concatenate([ball.nodes for ball in loaded]),
        force,
        np.concatenate([ball.shares for ball in loaded]) / len(loaded),
    )


def joint_displacements(displacements: Floats, balls: list[Ball]) -> Floats:
    """(n, 3) mm, the mean displacement of each joint's ball, from (nodes, 3) of all nodes."""
    return np.array([ball.shares @ displacements[ball.nodes] for ball in balls])
