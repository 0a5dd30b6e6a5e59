# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls: the distance to a surface that repeats, and the octants of what is solid beside it.

One period has eight octants, so that placing, certificate, trimming and streaming know nothing of
TPMS. At the outside of a block flat faces close them.
"""
