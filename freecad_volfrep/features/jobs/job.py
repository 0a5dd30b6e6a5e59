# SPDX-License-Identifier: LGPL-2.1-or-later
"""A job of the engine and the state that it is in: the one state machine of all that is made."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from volfrep.process.worker import Call


class State(Enum):
    """Where a job is; `NEXT` has what may follow."""

    #: Nothing is wanted: it has arrived, or was dropped, or there was none.
    IDLE = "idle"
    #: Asked for; others come first.
    WAITING = "waiting"
    RUNNING = "running"
    #: The user has cancelled it, and it has not ended yet.
    CANCELLING = "cancelling"
    #: Its result is being taken into the document.
    ARRIVING = "arriving"
    CANCELLED = "cancelled"
    FAILED = "failed"


NEXT = {
    State.IDLE: {State.IDLE},
    State.WAITING: {State.RUNNING, State.CANCELLING, State.CANCELLED, State.FAILED, State.IDLE},
    State.RUNNING: {
        State.ARRIVING, State.CANCELLING, State.CANCELLED, State.FAILED, State.IDLE,
    },
    # What was made before the cancel came may still arrive.
    State.CANCELLING: {State.ARRIVING, State.CANCELLED, State.FAILED, State.IDLE},
    State.ARRIVING: {State.CANCELLING, State.CANCELLED, State.FAILED, State.IDLE},
    State.CANCELLED: {State.IDLE},
    State.FAILED: {State.IDLE},
}  # fmt: skip
_UNDER_WAY = {State.WAITING, State.RUNNING, State.CANCELLING, State.ARRIVING}


class Job:
    """Something that is made; without a call there is none, and it is idle.

    Args:
        title: in the window.
        call: of the engine.
    """

    def __init__(self, title: str = "", call: Call | None = None) -> None:
        self.title, self.call = title, call
        self.state = State.IDLE if call is None else State.WAITING

    @property
    def is_under_way(self) -> bool:
        """Whether its result is still to come."""
        return self.state in _UNDER_WAY

    def go(self, state: State) -> None:
        """Be in the next state.

        Raises:
            ValueError: it cannot follow.
        """
        if state not in NEXT[self.state]:
            raise ValueError(f"a job that is {self.state.value} cannot be {state.value} next")
        self.state = state
