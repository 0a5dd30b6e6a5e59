# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run pytest inside FreeCAD's own interpreter: ``freecadcmd tools/run_in_freecad.py``.

pytest's arguments come in the environment variable PYTEST_ARGS (default: ``tests/freecad``),
because freecadcmd refuses options it does not know and opens other arguments as files. The exit
code is pytest's own, or 99 where pytest could not be started. FREECAD_USER_HOME must name a
profile whose Mod folder holds this checkout, as tools/setup.sh makes it in .cache/fchome.
"""

import os
import shlex
import sys
import traceback
from pathlib import Path

root = Path(__file__).resolve().parent.parent
# freecadcmd runs a script that raises a second time and then exits with 0: leave by os._exit,
# whatever happens.
code = 99
try:
    os.chdir(root)
    import pytest

    options = ["-p", "no:cacheprovider", "--rootdir", str(root)]
    code = int(pytest.main(options + shlex.split(os.environ.get("PYTEST_ARGS", "tests/freecad"))))
except SystemExit as leaving:
    code = leaving.code if isinstance(leaving.code, int) else 99
except BaseException:
    traceback.print_exc()
finally:
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)
