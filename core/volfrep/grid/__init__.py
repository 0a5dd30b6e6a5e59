# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cells over a domain: coordinate maps, active cells, nodes and struts, their placement."""
