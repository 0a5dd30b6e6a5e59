# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a part can be written as: one table of forms, a module a family, and one door to them.

Bytes are written by `io.write`; what is written comes from a `sources.Source`.
"""
