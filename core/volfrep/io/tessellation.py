# SPDX-License-Identifier: LGPL-2.1-or-later
"""How finely CAD shapes are cut into facets, in FreeCAD's window and on the command line alike."""

#: Largest distance between a facet and the shape: this part of the diagonal of the shape's box...
RELATIVE_DEVIATION = 1.0 / 4000.0
#: ...but no more than this, in mm; and the largest angle between neighbours on a curve, radians.
MAX_DEVIATION = 0.1
ANGULAR_DEVIATION = 0.2
