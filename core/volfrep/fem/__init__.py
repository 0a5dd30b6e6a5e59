# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elements for a solver: beams with stiff ends, tetrahedra, loads at joints."""
