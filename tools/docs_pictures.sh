#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# The pictures of the tutorial and the help pages, from those that the scripts of tests/gui
# left in build/gui: smaller, with few colours, so that each has less than 150 kB.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
OUT=docs/images/tutorial
declare -A PICTURES=(
  [1_select]=tutorial_1_select [2_panel]=tutorial_2_panel [3_preview]=preview_only
  [4_computed]=tutorial_4_computed [5_radius]=property_recomputed [6_check]=check_mesh
  [7_export]=export [cell_library]=cell_library [statistics]=statistics
  [section_view]=section_2_moved [colour_by]=colours_1_radius
  [sizing_plot]=sizing_2_plot [picking]=11_picked_direction [size_lattice]=sizing_2_sized
  [strut_results]=results_deformed
  [example_bracket]=example_bracket [example_piston_rod]=example_piston_rod
)
mkdir -p "$OUT"
for name in "${!PICTURES[@]}"; do
  convert "build/gui/${PICTURES[$name]}.png" -resize 800x -dither None -colors 128 -strip \
    "PNG8:$OUT/$name.png"
  bytes=$(stat -c %s "$OUT/$name.png")
  if ((bytes >= 150000)); then
    echo "docs_pictures: $OUT/$name.png has $bytes bytes" >&2
    exit 1
  fi
done
