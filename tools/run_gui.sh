#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Run a script in the real FreeCAD with its windows, on a virtual screen:
#     tools/run_gui.sh tests/gui/drive_lattice_infill.py              # all its checks
#     tools/run_gui.sh tests/gui/drive_lattice_infill.py open_a_face  # one, or some
#     tools/run_gui.sh tests/gui/drive_tree.py tests/gui/drive_fresh.py   # several in one window
#     tools/run_gui.sh --list tests/gui/drive_lattice_infill.py       # their names
# MARK chooses by the checks' marks, as pytest's -m: "not slow" leaves out those marked as slow.
# The exit code is the one that the script leaves with (by os._exit), or 124 after GUI_TIMEOUT
# seconds. GUI_SCREEN is the size of the screen (1400x900). Real clicks can go astray on a busy
# machine, so a check that fails has a second try on
# its own (GUI_TRIES=1: none): what held only then is told in lines that begin with AGAIN. Pictures and figures go to GUI_OUT (default: build/gui). Every run has a screen and a
# profile of its own, which are gone afterwards: none finds what another one left.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
if [ "${1:-}" = --list ]; then
  # The table at the script's end.
  exec sed -nE '/^run_checks\(/,$ s/^ +([a-z_]+): .*/\1/p' "$2"
fi
scripts=()
while [[ "${1:-}" = *.py ]]; do
  scripts+=("$1")
  shift
done
export GUI_CHECKS="$*"
script=${scripts[0]}
if [ ${#scripts[@]} -gt 1 ]; then
  export GUI_SCRIPTS="${scripts[*]}"
  script=$(dirname "$script")/together.py
fi
export GUI_OUT=${GUI_OUT:-$PWD/build/gui}
mkdir -p "$GUI_OUT"

own=$(mktemp -d)
screen=
# Without word of the screen's end.
trap '[ -z "$screen" ] || { kill "$screen"; wait "$screen"; } 2>/dev/null || true; rm -rf "$own"' EXIT
cp -rP "${FREECAD_USER_HOME:-$PWD/.cache/fchome}"/{Mod,AdditionalPythonPackages} "$own"
export FREECAD_USER_HOME=$own

# The server looks for a free number itself and tells it once it can be used.
mkfifo "$own/number"
Xvfb -displayfd 7 -screen 0 "${GUI_SCREEN:-1400x900}x24" -dpi 96 -nolisten tcp 7>"$own/number" 2>"$own/screen.log" &
screen=$!
read -r number <"$own/number" || { cat "$own/screen.log" >&2; exit 1; }
export DISPLAY=:$number
unset XAUTHORITY

# The start page is a web view, which refuses to run as root in its sandbox.
export QTWEBENGINE_DISABLE_SANDBOX=1
export LIBGL_ALWAYS_SOFTWARE=1 QT_XCB_GL_INTEGRATION=xcb_glx
# A screen of whole pixels is not quite one of 96 dpi: Qt would scale its windows by that bit, and
# real clicks would miss what they aim at by a pixel.
export QT_FONT_DPI=96
drive() {
  timeout "${GUI_TIMEOUT:-$((900 * ${#scripts[@]}))}" freecad "$script" 2>&1 | tee "$own/said"
  return "${PIPESTATUS[0]}"
}
status=0
drive || status=$?
if [ "$status" != 0 ] && [ "$status" != 124 ] && [ "${GUI_TRIES:-2}" != 1 ]; then
  failed=$(sed -nE 's/^FAILED ([a-z_]+): .*/\1/p' "$own/said" | sort -u | tr '\n' ' ')
  # FreeCAD that dies names none: then all are tried again.
  export GUI_CHECKS=${failed:-$GUI_CHECKS}
  printf 'AGAIN %s: exit code %s, %s\n' "${scripts[*]}" "$status" "${failed:-before its end}"
  sed -nE 's/^FAILED (.*)/AGAIN first: \1/p' "$own/said"
  status=0
  drive || status=$?
fi
exit "$status"
