# SPDX-License-Identifier: LGPL-2.1-or-later
"""The door to the engine: called before anything of it that computes is imported."""

from __future__ import annotations

import os

from volfrep.util.errors import VolfrepError
from volfrep.util.manifold import INSTALL

from .compat import repair_lazy_loader
from .deps import explain_missing, install_command, missing_optional, missing_packages
from .engines import python_program
from .preferences import THREADS, read


def require_engine() -> None:
    """Make sure that the engine can be imported, and uses as many threads as preferred.

    Packages that only some jobs need may be missing: those jobs say so.

    Raises:
        VolfrepError: Python packages are missing; the text says which command installs them.
    """
    missing = missing_packages()
    if missing:
        raise VolfrepError(explain_missing(missing))
    optional = missing_optional()
    if optional and INSTALL not in os.environ:
        # What needs it says so, here or in a process beside FreeCAD, with the command for this one.
        os.environ[INSTALL] = install_command(optional)
    repair_lazy_loader()
    from volfrep.process.worker import has_python, python_beside
    from volfrep.util.threads import use_threads

    use_threads(read(THREADS))
    if not has_python():
        python_beside(python_program(0))
