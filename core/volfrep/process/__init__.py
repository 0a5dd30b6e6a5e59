# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every process that is started: other programs, and Pythons that make calls of the engine."""
