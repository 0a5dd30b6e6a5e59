#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# What users get, from a tag, in build/release: the add-on's archive, reviewed by the index's rules,
# and the engine's wheel and source distribution.
#     tools/release.sh            # the tag v<version>
#     tools/release.sh HEAD       # any other state, to try it
#     tools/release.sh .          # what lies here, with or without git
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
refuse() { printf 'release: %s\n' "$*" >&2; exit 1; }
python=$PWD/.venv/bin/python
version=$(sed -nE 's/^VERSION = "(.*)"/\1/p' core/volfrep/util/version.py)
state=${1:-v$version}
target=$PWD/build/release
source=$(mktemp -d)
trap 'rm -rf "$source"' EXIT
if [ "$state" = . ]; then
  tar -c --exclude=./.git --exclude=./.venv --exclude=./.cache --exclude=./build \
    --exclude='*_cache' --exclude=__pycache__ --exclude='*.egg-info' . | tar -x -C "$source"
else
  git rev-parse -q --verify "$state^{commit}" >/dev/null ||
    refuse "there is no tag '$state': make it with 'git tag -a $state', or name another state."
  git archive "$state" | tar -x -C "$source"
fi
git -C "$source" init -q
git -C "$source" add -A
for place in "package.xml" "core/volfrep/util/version.py" "CHANGELOG.md" "CITATION.cff"; do
  grep -qF "$version" "$source/$place" || refuse "$place does not name the version $version."
done
rm -rf "$target"
mkdir -p "$target"
(
  cd "$source"
  "$python" tools/addon_archive.py "$target/VOLFREP"
  "$python" tools/index_review.py "$target/VOLFREP-$version.zip"
  "$python" -m pip wheel --quiet --disable-pip-version-check --no-deps -w "$target" .
  rm -rf build
  "$python" -c "from setuptools import build_meta; print(build_meta.build_sdist('$target'))" >/dev/null
)
ls -l "$target"
