#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Run a script in the real FreeCAD with its windows, on a virtual screen:
#     tools/run_gui.sh tests/gui/drive_lattice_infill.py              # all its checks
#     tools/run_gui.sh tests/gui/drive_lattice_infill.py open_a_face  # one, or some
#     tools/run_gui.sh --list tests/gui/drive_lattice_infill.py       # their names
# The exit code is the one that the script leaves with (by os._exit), or 124 after GUI_TIMEOUT
# seconds. Pictures and figures go to GUI_OUT (default: build/gui).
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
if [ "${1:-}" = --list ]; then
  # The table at the script's end.
  exec sed -nE '/^run_checks\(/,$ s/^ +([a-z_]+): .*/\1/p' "$2"
fi
script=$1
shift
export GUI_CHECKS="$*"
export FREECAD_USER_HOME=${FREECAD_USER_HOME:-$PWD/.cache/fchome-gui}
export GUI_OUT=${GUI_OUT:-$PWD/build/gui}
mkdir -p "$GUI_OUT"
# The start page is a web view, which refuses to run as root in its sandbox.
export QTWEBENGINE_DISABLE_SANDBOX=1
export LIBGL_ALWAYS_SOFTWARE=1 QT_XCB_GL_INTEGRATION=xcb_glx
# Without a resolution of 96 dpi Qt scales its windows and real clicks miss their buttons.
exec timeout "${GUI_TIMEOUT:-900}" \
  xvfb-run -a -s "-screen 0 1400x900x24 -dpi 96" freecad "$script"
