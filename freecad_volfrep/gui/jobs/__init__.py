# SPDX-License-Identifier: LGPL-2.1-or-later
"""Jobs in the window: waited for, in steps, in background; what makes a mesh up to date."""
