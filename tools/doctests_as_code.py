# SPDX-License-Identifier: LGPL-2.1-or-later
"""For the site: examples in docstrings are code, not quotations (an extension of Griffe)."""

from __future__ import annotations

import re
from typing import Any

import griffe

#: A paragraph that begins with a prompt, with what was printed.
_EXAMPLE = re.compile(r"^>>> .*(?:\n(?!\n|```).+)*", re.MULTILINE)


class DoctestsAsCode(griffe.Extension):
    """Fences round each example of each docstring."""

    def on_instance(self, *, obj: griffe.Object, **_: Any) -> None:
        """Change the docstring of what was read, if it has one."""
        if obj.docstring:
            obj.docstring.value = _EXAMPLE.sub(r"```pycon\n\g<0>\n```", obj.docstring.value)
