#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Install the other tools of the benchmark into .cache/bench; takes no time when they are there.
# What cannot be installed is left out, and the benchmark's rows say so.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
# A peer in C++, where Debian's packages for it are: libopenvdb-dev, libtbb-dev, libboost-iostreams-dev.
peer=.cache/bench-openvdb/openvdb_part source=bench/openvdb_part.cc
if [ -e /usr/include/openvdb/openvdb.h ] && [ "$source" -nt "$peer" ]; then
  mkdir -p "${peer%/*}"
  g++ -O3 -std=c++17 "$source" -o "$peer" -lopenvdb -ltbb -lImath-3_1 ||
    printf 'bench: %s could not be compiled and is left out\n' "$source" >&2
fi
wanted=tools/requirements-bench.txt stamp=.cache/bench/stamp python=.cache/bench/bin/python
if [ -e "$stamp" ] && cmp -s "$wanted" "$stamp" && "$python" -c '' 2>/dev/null; then
  exit 0
fi
printf 'bench: other tools into .cache/bench\n'
/usr/bin/python3 -m venv .cache/bench
if "$python" -m pip install --quiet --disable-pip-version-check -r "$wanted"; then
  cp "$wanted" "$stamp"
  exit 0
fi
printf 'bench: not all of them together: one by one\n' >&2
while read -r package; do
  "$python" -m pip install --quiet --disable-pip-version-check "$package" ||
    printf 'bench: %s could not be installed and is left out\n' "$package" >&2
done < <(grep -E '^[a-z]' "$wanted")
