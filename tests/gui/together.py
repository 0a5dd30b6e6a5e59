# SPDX-License-Identifier: LGPL-2.1-or-later
"""Several scripts in one window, each check after a clearing as in a window of its own.

tools/run_gui.sh gives their names in GUI_SCRIPTS. To start FreeCAD takes 6 s of processor time.
"""

import importlib
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import run_tables

for script in os.environ["GUI_SCRIPTS"].split():
    importlib.import_module(Path(script).stem)
run_tables()
