# SPDX-License-Identifier: LGPL-2.1-or-later
"""The words of the window in the user's language.

`translate(context, text)` gives a text in that language; `QT_TRANSLATE_NOOP(context, text)` only
marks one, for a table that is translated when it is shown. Both names are what ``make
translations`` looks for. What varies is put in afterwards: ``translate(...).format(name=...)``.

What is stored in documents and files is never translated; panels and the report view show it by way
of `sentences.localise`.
"""

from __future__ import annotations

import re
from pathlib import Path

import FreeCAD as App

translate = App.Qt.translate
QT_TRANSLATE_NOOP = App.Qt.QT_TRANSLATE_NOOP
#: Compiled: volfrep_de.qm and the like.
TRANSLATIONS = Path(__file__).resolve().parent / "resources" / "translations"

#: What stands in numbers: before tenths, and between thousands.
POINT, GROUP = QT_TRANSLATE_NOOP("VolfrepNumbers", "."), QT_TRANSLATE_NOOP("VolfrepNumbers", ",")

__all__ = [
    "QT_TRANSLATE_NOOP",
    "TRANSLATIONS",
    "figure",
    "grouped",
    "marked",
    "spaced",
    "spoken",
    "translate",
]


def marked(context: str, *texts: str) -> tuple[str, ...]:
    """Mark many texts that others write, to be translated where they are shown."""
    return texts


def grouped(number: int) -> str:
    """A whole number as the user's language groups its digits."""
    return spoken(f"{number:,}")


def figure(number: float, digits: int = 2) -> str:
    """A number of so many digits, written out, in the user's notation."""
    return spoken(f"{float(f'{number:.{digits}g}'):,.15g}")


def spoken(text: str) -> str:
    """An English number with the user's points and commas: FreeCAD's windows have those of Qt."""
    point, group = (translate("VolfrepNumbers", mark) for mark in (POINT, GROUP))
    return text.replace(",", "\0").replace(".", point).replace("\0", group)


def spaced(name: str) -> str:
    """A property's name as FreeCAD's property editor shows and translates it: 'Radius Min'."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)
