#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# The pictures of the tutorial and the help pages anew: runs the checks of tests/gui that take them,
# rings what they mark, where the user clicks, and makes them smaller, with few colours, so that
# each has less than 150 kB. With an argument it takes those that are in that folder already, and of
# build/forky/gui, which are FreeCAD 1.1's, those that show what looks different there.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
OUT=docs/images/tutorial
only=.
if [[ ${1:-} = *forky* ]]; then
  OUT=$OUT/1.1
  only='[^_](1_select|2_panel|4_computed|5_radius|6_check)$'
fi
# The script of tests/gui, its check, the picture that it takes, and what that is called here.
PICTURES="
commands        fill_a_box              tutorial_1_select    1_select
commands        fill_a_box              tutorial_2_panel     2_panel
commands        preview_without_a_mesh  preview_only         3_preview
commands        fill_a_box              tutorial_4_computed  4_computed
commands        type_a_radius           property_recomputed  5_radius
commands        check_the_mesh          check_mesh           6_check
commands        export_by_typing_a_name export               7_export
commands        use_the_cell_library    cell_library         cell_library
commands        read_the_statistics     statistics           statistics
commands        open_the_bracket        example_bracket      example_bracket
commands        open_the_piston_rod     example_piston_rod   example_piston_rod
display         section                 section_2_moved      section_view
display         colours                 colours_1_radius     colour_by
lattice_infill  pick_in_the_panel       11_picked_direction  picking
lattice_infill  choose_walls            panel_6_walls        walls_panel
sizing          size_and_take           sizing_2_plot        sizing_plot
sizing          size_and_take           sizing_2_sized       size_lattice
sizing          size_a_network          network_3_sized      network_sized
sizing          show_results            results_deformed     strut_results
"
rows() { grep -E "$only" <<<"$PICTURES"; }
# One of them shows the folder.
from=${1:-/tmp/volfrep}
export GUI_OUT=$from
if [ $# = 0 ]; then
  for script in $(rows | awk '{print $1}' | uniq); do
    mapfile -t checks < <(rows | awk -v script="$script" '$1 == script {print $2}' | sort -u)
    tools/run_gui.sh "tests/gui/drive_$script.py" "${checks[@]}" </dev/null
  done
fi
mkdir -p "$OUT"
while read -r _ _ taken name; do
  rings=()
  if [ -e "$from/$taken.marks" ]; then
    while read -r one other; do
      rings+=(-draw "roundrectangle $one $other 6,6")
    done <"$from/$taken.marks"
  fi
  convert "$from/$taken.png" -fill none -stroke '#e01b24' -strokewidth 4 "${rings[@]}" \
    -resize 800x -dither None -colors 128 -strip "PNG8:$OUT/$name.png"
  bytes=$(stat -c %s "$OUT/$name.png")
  if ((bytes >= 150000)); then
    echo "docs_pictures: $OUT/$name.png has $bytes bytes" >&2
    exit 1
  fi
done < <(rows)
