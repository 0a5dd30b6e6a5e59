# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coin's scene: meshes, struts and colours as nodes, the legend, an arrow, the mouse."""
