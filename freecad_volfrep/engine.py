# SPDX-License-Identifier: LGPL-2.1-or-later
"""The door to the engine: called before anything of it that computes is imported."""

from __future__ import annotations

from volfrep.util.errors import VolfrepError

from .compat import repair_lazy_loader
from .deps import explain_missing, missing_packages
from .preferences import THREADS, read


def require_engine() -> None:
    """Make sure that the engine can be imported, and uses as many threads as preferred.

    Raises:
        VolfrepError: Python packages are missing; the text says which command installs them.
    """
    missing = missing_packages()
    if missing:
        raise VolfrepError(explain_missing(missing))
    repair_lazy_loader()
    from volfrep.util.threads import use_threads

    use_threads(read(THREADS))
