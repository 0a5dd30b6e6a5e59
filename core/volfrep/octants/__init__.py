# SPDX-License-Identifier: LGPL-2.1-or-later
"""The surface of the lattice in one octant: signed distances, meshing, caps."""
