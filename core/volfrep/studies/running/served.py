# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a process that `apart` has started does.

It reads pickled runs and answers with a line each; when the pipe closes, because whoever started it
is gone, it ends at once.
"""

from __future__ import annotations

import os
import pickle
import queue
import sys
import threading
from typing import IO

from ...util.errors import VolfrepError
from ...util.version import VERSION
from ..designs import Design
from .batches import DONE, Batch
from .evaluator import Shared
from .runs import evaluator_of, run_design

__all__ = ["VERSION", "serve"]


def serve() -> None:
    """What the process does until its pipe closes; called by nobody else."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # whoever started us decides
    answers = os.fdopen(os.dup(1), "wb", buffering=0)
    os.dup2(2, 1)  # what libraries print is no answer
    sent: queue.SimpleQueue[object] = queue.SimpleQueue()
    threading.Thread(target=_receive, args=(sys.stdin.buffer, sent), daemon=True).start()
    batch = sent.get()
    assert isinstance(batch, Batch)
    from ...util.threads import use_threads

    use_threads(batch.threads)
    shared = Shared()
    while True:
        design = sent.get()
        assert isinstance(design, Design)
        try:
            run_design(batch, design, evaluator_of(batch, design, shared))
            answers.write(DONE)
        except VolfrepError as error:
            answers.write(str(error).replace("\n", " ").encode() + b"\n")


def _receive(stream: IO[bytes], sent: queue.SimpleQueue[object]) -> None:
    """Pass on what is sent; end this process when nobody is there any more."""
    while True:
        try:
            sent.put(pickle.load(stream))
        except EOFError:
            os._exit(0)
