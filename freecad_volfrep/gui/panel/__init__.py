# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of a lattice infill, and its fields."""
