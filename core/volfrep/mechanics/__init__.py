# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a cell's lattice does: density, stiffness, strength, conductance; materials; a catalogue."""
