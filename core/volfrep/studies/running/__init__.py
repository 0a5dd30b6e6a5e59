# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the runs of a study are done: one by one, in processes, by any executor."""
