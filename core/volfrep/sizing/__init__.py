# SPDX-License-Identifier: LGPL-2.1-or-later
"""From loads to radii: frames of tapered struts with a skin, solved and sized."""
