# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a lattice has and does: the properties of an endless one, and quantities point by point."""
