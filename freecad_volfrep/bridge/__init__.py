# SPDX-License-Identifier: LGPL-2.1-or-later
"""The only place where FreeCAD's shapes and meshes become the engine's arrays, and back."""
