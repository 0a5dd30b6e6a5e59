# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run came to: its report and result, estimates, print checks, what a file holds."""
