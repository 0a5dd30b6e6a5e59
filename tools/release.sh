#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# What users get, from a tag, in build/release: the add-on's archive, reviewed by the index's rules,
# the engine's wheel and source distribution, and the documentation's site.
#     tools/release.sh            # the tag v<version>
#     tools/release.sh HEAD       # any other state, to try it
#     tools/release.sh .          # what lies here, with or without git
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
refuse() { printf 'release: %s\n' "$*" >&2; exit 1; }
repository=$PWD
python=$repository/.venv/bin/python
target=$repository/build/release
# VERSION is the one place; all others repeat it.
version_in() { sed -nE 's/^VERSION = "(.*)"/\1/p' "$1/core/volfrep/util/version.py"; }
state=${1:-v$(version_in .)}
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
version=$(version_in "$source")
if [ "$state" != "v$version" ] && git rev-parse -q --verify "refs/tags/$state" >/dev/null 2>&1; then
  refuse "the tag '$state' stands at a state whose version is $version: tag it 'v$version', or set \
VERSION in core/volfrep/util/version.py first."
fi
read -r newest date < <(sed -nE 's/^## (\S+) \((.*)\)$/\1 \2/p' "$source/CHANGELOG.md") || true
[ "$newest" = "$version" ] ||
  refuse "CHANGELOG.md begins with version '$newest', and the version is $version."
[[ "$date" =~ ^[0-9]{4}-[0-9]{2}-[0-9]{2}$ ]] ||
  refuse "CHANGELOG.md gives version $version no date but '$date': write the day, as 2026-11-24."
says() { grep -qF "$2" "$source/$1" || refuse "$1 does not say '$2', as CHANGELOG.md does."; }
says package.xml "<version>$version</version>"
says package.xml "<date>$date</date>"
says CITATION.cff "version: $version"
says CITATION.cff "date-released: $date"

rm -rf "$target"
mkdir -p "$target"
cd "$source"
git init -q
git add -A
"$python" tools/addon_archive.py "$target/VOLFREP"
"$python" tools/index_review.py "$target/VOLFREP-$version.zip"
NO_MKDOCS_2_WARNING=1 "$repository/.cache/site/bin/python" tools/site.py
mv build/site "$target/site"
# Where the package is listed nothing lies beside its README.
address=$(sed -nE 's|.*<url type="repository"[^>]*>(.*)</url>.*|\1|p' package.xml)
sed -Ei "s#(!\[[^]]*\]\()(docs/)#\1$address/raw/v$version/\2#g
  s#\]\((docs/|[A-Z]+\.md|LICENSE)#](${address}/blob/v$version/\1#g" README.md
export PYTHONWARNINGS=ignore
"$python" -m pip wheel --quiet --disable-pip-version-check --no-deps -w "$target" .
rm -rf build
"$python" -c "from setuptools import build_meta; print(build_meta.build_sdist('$target'))" >/dev/null
ls -l "$target"
