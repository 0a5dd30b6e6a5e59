# SPDX-License-Identifier: LGPL-2.1-or-later
"""The compiled translations are those of the .ts files, and FreeCAD finds them."""

from xml.etree import ElementTree

import pytest
from PySide import QtCore

from freecad_volfrep.features.jobs.progress import job_title
from freecad_volfrep.translation import TRANSLATIONS, spaced, translate

FILES = sorted(TRANSLATIONS.glob("volfrep_*.ts"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_what_is_compiled_is_up_to_date(path):
    translator = QtCore.QTranslator()
    assert translator.load(str(path.with_suffix(".qm")))
    count = 0
    for context in ElementTree.parse(path).getroot().iter("context"):
        for message in context.iter("message"):
            name, text = context.findtext("name"), message.findtext("source")
            assert translator.translate(name, text) == message.findtext("translation"), text
            count += 1
    assert count > 300


def test_without_a_translation_a_text_is_itself(box):
    assert translate("VolfrepTaskPanel", "Compute") == "Compute"
    assert job_title("Filling {label}", box) == "Filling Solid"


def test_names_of_properties_are_read_as_words():
    assert spaced("RadiusStart") == "Radius Start"
    assert spaced("Base") == "Base"
