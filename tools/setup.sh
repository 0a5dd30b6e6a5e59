#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Install what the project needs on Debian 12 or 13: FreeCAD and the tools of its tests from
# Debian, the engine and its Python packages into .venv, and a private FreeCAD profile in .cache
# that sees this checkout as the workbench. Runs again only when its inputs change.
#     tools/setup.sh          # all of it
#     tools/setup.sh light    # what `make check` needs: Python, without FreeCAD and other programs
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
root=$PWD
system_python=/usr/bin/python3
debian_packages=(python3 python3-venv python3-pip python3-numpy python3-scipy ca-certificates git)
in_freecad=(freecad python3-vtk9 xvfb xauth xdotool imagemagick libgl1-mesa-dri)
# Programs that only tests open our files with: without them those tests are skipped and say so.
# What the last three are for: CHOLMOD, which scikit-sparse is compiled against.
tools=(admesh prusa-slicer cura-engine gmsh libsuitesparse-dev python3-dev g++)
# Debian 13 has no CalculiX.
grep -qs '^VERSION_ID="13"' /etc/os-release || tools+=(calculix-ccx)
level=${1:-$([ -z "${SETUP_WITHOUT_TOOLS:-}" ] && echo tools || echo freecad)}
[ "$level" = light ] || debian_packages+=("${in_freecad[@]}")
[ "$level" != tools ] || debian_packages+=("${tools[@]}")

say() { printf 'setup: %s\n' "$*"; }
refuse() { printf 'setup: %s\n' "$*" >&2; exit 1; }

fingerprint_of() {
  {
    printf '%s\n' "$root" "$1"
    cat tools/setup.sh tools/requirements-{dev,plot,study}.txt pyproject.toml
  } | sha256sum
}
stamp=.venv/setup-stamp
if [ -e "$stamp" ] && [ -x .venv/bin/volfrep ] && [ -e .cache/fchome/Mod/VOLFREP ] &&
  .venv/bin/python -c '' 2>/dev/null; then
  # What was set up with more serves as well.
  case $level in light) enough="light freecad tools" ;; *) enough=$level ;; esac
  for one in $enough; do
    [ "$(cat "$stamp")" != "$(fingerprint_of "$one")" ] || exit 0
  done
fi

command -v dpkg-query >/dev/null || refuse "this set-up knows only Debian: install FreeCAD, make a \
Python environment for its Python and run 'pip install -e .' there."
missing=()
for package in "${debian_packages[@]}"; do
  state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  [ "$(id -u)" = 0 ] ||
    refuse "these Debian packages are missing: run 'apt-get install ${missing[*]}' as root."
  say "Debian packages: ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq || refuse "apt-get update failed: is the network up?"
  log=$(mktemp)
  if ! apt-get install -y -qq --no-install-recommends "${missing[@]}" >"$log" 2>&1; then
    cat "$log" >&2
    refuse "apt-get could not install ${missing[*]}: see above."
  fi
  rm -f "$log"
fi

# CuraEngine's printer definitions are in Debian's package of the whole Cura, which brings fifty
# others: only its own files are unpacked.
mkdir -p .cache
if [ "$level" = tools ] && [ ! -d .cache/cura ]; then
  say "Cura's printer definitions"
  archive=$(mktemp -d)
  (cd "$archive" && apt-get download -qq cura) || refuse "apt-get could not download 'cura'."
  dpkg-deb -x "$archive"/cura_*.deb .cache/cura
  rm -r "$archive"
fi

# FreeCAD runs on Debian's Python: packages for any other would not load inside it.
version_of() { "$1" -c 'import sys; print(sys.version_info[:2], sys.base_prefix)'; }
if [ -x .venv/bin/python ] && [ "$(version_of .venv/bin/python)" != "$(version_of $system_python)" ]
then
  say ".venv belongs to another Python: making it anew"
  rm -rf .venv
fi
grep -qs '^include-system-site-packages = true' .venv/pyvenv.cfg && [ -x .venv/bin/pip ] ||
  $system_python -m venv --clear --system-site-packages .venv
rm -f "$stamp"

# numpy and scipy stay Debian's own: FreeCAD's compiled modules were built against them.
$system_python - >.cache/constraints.txt <<'PYTHON'
import numpy
import scipy

print(f"numpy=={numpy.__version__}")
print(f"scipy=={scipy.__version__}")
PYTHON
say "Python packages"
# What the light one installs is compiled when it is used: not all of it is.
.venv/bin/python -m pip install --quiet --disable-pip-version-check \
  $([ "$level" != light ] || echo --no-compile) \
  -c .cache/constraints.txt -r tools/requirements-dev.txt -e . ||
  refuse "pip could not install the Python packages: see above."

for kind in plot study; do
  wanted=tools/requirements-$kind.txt
  [ "$level" = tools ] && ! cmp -s "$wanted" .cache/$kind/requirements.txt || continue
  say "packages of $wanted, apart from what FreeCAD sees"
  rm -rf .cache/$kind
  .venv/bin/python -m pip install --quiet --disable-pip-version-check --no-deps \
    --target .cache/$kind -r "$wanted" ||
    refuse "pip could not install the packages of $wanted: see above."
  cp "$wanted" .cache/$kind/requirements.txt
done

if [ "$level" = tools ] && ! .venv/bin/python -c 'from sksparse.cholmod import analyze' 2>/dev/null; then
  say "scikit-sparse, compiled"
  .venv/bin/python -m pip install --quiet --disable-pip-version-check -c .cache/constraints.txt \
    -e '.[cholmod]' || say "scikit-sparse could not be compiled: tests of CHOLMOD are skipped."
fi

site=$(.venv/bin/python -c 'import sysconfig; print(sysconfig.get_paths()["purelib"])')
# The profile of freecadcmd; every run of a window has a copy of it.
mkdir -p .cache/fchome/Mod
ln -sfn "$root" .cache/fchome/Mod/VOLFREP
ln -sfn "$site" .cache/fchome/AdditionalPythonPackages
fingerprint_of "$level" >"$stamp"
ready=$(.venv/bin/python --version)
[ "$level" = light ] || ready+=", FreeCAD $(dpkg-query -W -f='${Version}' freecad)"
say "ready: $ready"
