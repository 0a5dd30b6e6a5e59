# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many designs at once: which there are, what is done with each, their table and Pareto front."""
