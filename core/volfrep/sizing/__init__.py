# SPDX-License-Identifier: LGPL-2.1-or-later
"""From loads to radii: load cases, what of a body they act on, and struts sized for them."""
