#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# The animation of the README and the Overview anew, from the real window: tests/gui/film.py takes
# the frames, each with how long it stays. Below 1.5 MB.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
export GUI_OUT=${1:-build/film} GUI_TRIES=1
[ $# -gt 0 ] || { rm -rf "$GUI_OUT"; tools/run_gui.sh tests/gui/film.py </dev/null; }
frames=()
while read -r hundredths name; do
  frames+=(-delay "$hundredths" "$GUI_OUT/$name")
done <"$GUI_OUT/film.txt"
convert "${frames[@]}" -resize 720x +dither -colors 96 -layers OptimizeTransparency -loop 0 \
  docs/images/film.gif
bytes=$(stat -c %s docs/images/film.gif)
((bytes < 1500000)) || { echo "film: docs/images/film.gif has $bytes bytes" >&2; exit 1; }
