#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Run the engine's tests on the newest numpy, scipy, scikit-image, trimesh and manifold3d, in an
# environment apart from the one that FreeCAD uses; lxml, networkx (3MF by trimesh) and matplotlib,
# elsewhere Debian's, come with them. PYTEST_ARGS picks the tests.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
python=.cache/newest/bin/python
[ -x "$python" ] || /usr/bin/python3 -m venv .cache/newest
"$python" -m pip install --quiet --disable-pip-version-check --upgrade \
  --upgrade-strategy eager -r tools/requirements-dev.txt -e . lxml matplotlib networkx
"$python" -m pip list --disable-pip-version-check 2>/dev/null |
  grep -E '^(numpy|scipy|scikit-image|trimesh|manifold3d) ' | sed 's/^/newest: /'
eval "exec $python -m pytest ${PYTEST_ARGS:-tests/core -m 'not slow' -n auto --dist loadfile}"
