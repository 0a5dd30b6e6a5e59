# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a job of the engine is run, and what a window does for it."""
