# SPDX-License-Identifier: LGPL-2.1-or-later
"""Triangle meshes as such: measures, remeshing, float32 repair, Booleans, precision."""
