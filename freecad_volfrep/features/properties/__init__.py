# SPDX-License-Identifier: LGPL-2.1-or-later
"""What FreeCAD's properties need: a row each, units, those of earlier releases."""
