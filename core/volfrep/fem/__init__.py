# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finite elements: meshes for a solver, CalculiX decks, its runs and results."""
