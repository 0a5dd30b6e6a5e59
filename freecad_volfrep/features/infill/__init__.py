# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice infill: its properties, its values, its mesh, its preview."""
