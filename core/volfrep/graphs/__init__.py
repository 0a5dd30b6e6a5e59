# SPDX-License-Identifier: LGPL-2.1-or-later
"""Any graph of nodes and struts as a lattice: joints of all angles, overlaps, random networks."""
