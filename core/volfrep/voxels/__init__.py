# SPDX-License-Identifier: LGPL-2.1-or-later
"""Any closed mesh solved as a solid, by brick finite elements on voxels.

What it shares with `sizing` is where loads and supports act, and nothing else: neither beams nor
shells nor a mesher. `shares` fills a grid with a mesh, `bricks` is the element, `multigrid` solves
its equations, `loaded` lays load cases on the voxels, `solution` says what came out.
"""
