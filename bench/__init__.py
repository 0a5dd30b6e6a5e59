# SPDX-License-Identifier: LGPL-2.1-or-later
"""The benchmark: the published paper's evaluation on this engine, beside other tools.

``python -m bench`` measures and writes docs/benchmarks.md; `bench.files` and `bench.beams` are
benchmarks of their own. Nothing here is part of the product.
"""
