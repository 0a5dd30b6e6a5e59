# SPDX-License-Identifier: LGPL-2.1-or-later
"""How an infill shows in the 3D view: filled, cut open, as a preview, by a proxy mesh."""
