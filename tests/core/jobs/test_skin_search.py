# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts under a skin as it went into the file: no heavier than they and it need be."""

from types import SimpleNamespace

import numpy as np
import pytest

from volfrep.jobs.sizing import skin_search
from volfrep.sizing.analysis import Limits


@pytest.mark.parametrize(
    ("stress", "volume"),
    [
        (lambda v: 100.0, 4.0),  # the lightest is borne
        (lambda v: 110.0 - v, 10.0),  # what lies between: no skin bears more than 100 MPa here
        (lambda v: 130.0 - v, 12.0),  # nor the heavy one: it stays
    ],
)
def test_struts_are_as_light_as_the_skin_bears(monkeypatch, stress, volume):
    def design(size):
        return SimpleNamespace(radii=np.array([float(size)]), volume=float(size))

    monkeypatch.setattr(
        skin_search, "lightest",
        lambda *_, **__: SimpleNamespace(holds=True, analysis=design(4.0)),
    )  # fmt: skip
    monkeypatch.setattr(skin_search, "thicken", lambda _, __, radii: (design(radii[0]), True))
    monkeypatch.setattr(skin_search, "skin_peaks", lambda _, one: [stress(one.volume)])
    model = SimpleNamespace(problem=None)
    found = skin_search.lighter(model, Limits(stress=100.0), design(12.0), 9, lambda *_: True)
    assert found.volume == pytest.approx(volume, abs=0.5)
