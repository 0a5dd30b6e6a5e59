# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands, view providers and windows; never imported by a FreeCAD without windows."""
