# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a part carries: regions, supports, loads and cases, their files, what each node gets."""
