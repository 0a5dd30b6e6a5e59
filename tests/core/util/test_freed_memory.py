# SPDX-License-Identifier: LGPL-2.1-or-later
"""Memory that was freed comes again without the system's help."""

import os
import platform
import subprocess
import sys

import pytest

#: Takes and frees ten arrays of 4 MB, twice; prints how many pages the system gave.
SCRIPT = """
import resource
import numpy as np
from volfrep.util.freed_memory import keep_freed_memory

def pages():
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    for _ in range(2):
        taken = [np.ones(1 << 19) for _ in range(10)]
        del taken
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before

print(pages())
keep_freed_memory()
pages()
print(pages())
"""


def pages_given(**variables: str) -> tuple[int, int]:
    """By the system before memory is kept, and afterwards."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith("MALLOC_")}
    said = subprocess.run(
        [sys.executable, "-c", SCRIPT], env={**clean, **variables}, capture_output=True, text=True,
        check=True,
    )  # fmt: skip
    before, after = map(int, said.stdout.split())
    return before, after


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="another C library")
def test_arrays_come_again_in_the_memory_of_those_before() -> None:
    before, after = pages_given()
    assert before > 5_000, "40 MB are 10,240 pages, fewer where some are large ones"
    assert after < before / 10


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="another C library")
def test_what_the_user_has_set_stays() -> None:
    before, after = pages_given(MALLOC_TRIM_THRESHOLD_="131072")
    assert after > before / 2
