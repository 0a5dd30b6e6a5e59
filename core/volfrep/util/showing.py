# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results as a terminal shows them, in a line, and a notebook, as a table: their figures alone."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

#: Characters of a line.
WIDTH = 160


class Shown:
    """A result that shows itself by its rows, and not by the arrays that it holds.

    >>> class Weight(Shown):
    ...     def rows(self):
    ...         return [("mass", "12 g")]
    >>> Weight()
    <Weight: mass 12 g>
    """

    def rows(self) -> Iterable[tuple[str, str]]:
        """Names and values, for people."""
        raise NotImplementedError

    def __repr__(self) -> str:
        text = "; ".join(f"{name} {value}".strip() for name, value in self.rows())
        text = text if len(text) <= WIDTH else f"{text[: WIDTH - 3]}..."
        return f"<{type(self).__name__}: {text}>"

    def _repr_html_(self) -> str:
        """A table for a notebook."""
        rows = (
            f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>"
            for name, value in self.rows()
        )
        return f"<table>{''.join(rows)}</table>"
