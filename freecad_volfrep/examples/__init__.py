# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two parts to fill, modelled parametrically: a lug bracket and a piston rod.

``make_bracket(doc)`` and ``make_piston_rod(doc)`` build ordinary FreeCAD objects (sketches,
extrusions, Booleans, fillets) whose sizes come from a spreadsheet in the same document: change a
cell, recompute, and the part and every lattice in it follow.
"""

from .bracket import make_bracket
from .piston_rod import make_piston_rod

__all__ = ["make_bracket", "make_piston_rod"]
