# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls: the distance to a surface that repeats, and the octants of what is solid beside it."""
