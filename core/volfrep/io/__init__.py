# SPDX-License-Identifier: LGPL-2.1-or-later
"""From files to solids and back: reading, repair, writing; a FreeCAD of its own for CAD files."""
