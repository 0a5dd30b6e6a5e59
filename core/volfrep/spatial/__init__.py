# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where points lie and what crosses: distances, lines through solids, intersections."""
