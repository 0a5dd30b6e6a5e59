# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user asks for: specification, unit cells, gradings, openings; what a job comes to."""
