# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part as a solid of the lattice's effective stiffness: as many cells as one likes.

`cell_law` is what a cell is as a material, `bricks` the elements, `model` what is solved of them,
`border` the struts in a free face that no homogenised cell knows, `deck` all of it for CalculiX.
"""
