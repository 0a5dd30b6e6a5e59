# SPDX-License-Identifier: LGPL-2.1-or-later
"""A study's page: one file with its plots, pictures and commands, as a parser of HTML reads it."""

from __future__ import annotations

import base64
import dataclasses
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path

import pytest

import samples
import volfrep
from volfrep import Front, Study
from volfrep.io.solid import check_solid
from volfrep.studies import page as page_module
from volfrep.studies.page import choose_plots

BOX = check_solid(samples.box((24.0, 16.0, 16.0)), "box")
STUDY = Study(
    parts=(BOX,),
    vary={"cell": ("BCC", "CVC"), "strut_radius": (0.7, 0.8, 0.9), "cell_size": (8.0, 40.0)},
    fixed={"shell": 1.0},
    front=Front({"forecast.mass_g": "least", "properties.E100": "most"}, (), 3),
)


class Page(HTMLParser):
    """What of a page a test looks at."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.opened: list[str] = []
        self.images: list[str] = []
        self.links: list[str] = []
        self.rows = 0
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list) -> None:
        given = dict(attrs)
        if tag not in ("meta", "img", "input", "wbr"):
            self.opened.append(tag)
        if tag == "img":
            self.images.append(given["src"])
        self.rows += tag == "tr" and given.get("class") in ("done", "front")
        self.links += [given[name] for name in ("href", "src") if name in given]

    def handle_endtag(self, tag: str) -> None:
        assert self.opened.pop() == tag


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("matplotlib", reason="plots need the optional package matplotlib")
    return volfrep.sweep(STUDY, tmp_path_factory.mktemp("runs")).page


@pytest.mark.costly
def test_a_page_is_made_of_itself(made: Path) -> None:
    page = Page(made.read_text())
    assert page.opened == []
    assert page.rows == 6
    assert [link for link in page.links if not link.startswith("data:")] == []


def test_its_plots_show_every_design_and_name_their_axes(made: Path) -> None:
    images = Page(made.read_text()).images
    drawings = [base64.b64decode(image.split(",")[1]).decode() for image in images]
    assert len(drawings) == 5
    first = drawings[0]
    assert "<!-- forecast.mass_g -->" in first
    assert "<!-- properties.E100 -->" in first
    assert first.count('<use xlink:href="#') >= 6 + 3  # designs, and rings about the chosen


@pytest.mark.skipif(not shutil.which("chromium"), reason="needs the browser chromium")
def test_a_browser_sorts_and_filters_its_table(made: Path, tmp_path: Path) -> None:
    heads = made.read_text().split("<thead>")[1].split("</tr>")[0]
    mass = heads.replace("<wbr>", "").split("<th>")
    column = next(k for k, head in enumerate(mass) if head.startswith("forecast.mass_g")) - 1
    act = f"""<script>
    document.querySelectorAll("#runs th")[{column}].click();
    const find = document.getElementById("find");
    find.value = "cvc"; find.dispatchEvent(new Event("input"));
    document.title = [...document.querySelectorAll("#runs tbody tr")].filter(r => !r.hidden)
      .map(r => r.cells[{column}].dataset.v).join(" ");
    </script></body>"""
    page = tmp_path / "acted.html"
    page.write_text(made.read_text().replace("</body>", act))
    told = subprocess.run(
        ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
         "--no-first-run", "--disable-background-networking", "--disable-component-update",
         "--disable-sync", f"--user-data-dir={tmp_path}", "--dump-dom", page.as_uri()],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    title = told.stdout.split("<title>")[1].split("</title>")[0]
    masses = [float(mass) for mass in title.split()]
    assert len(masses) == 3
    assert masses == sorted(masses)


def test_what_all_designs_share_is_said_once(made: Path) -> None:
    text = made.read_text()
    heads = text.split("<thead>")[1].split("</thead>")[0]
    assert "The same for all: part part, shell 1, cell_size 8, state done" in text
    assert heads.startswith("<tr><th>key</th><th>cell</th><th>strut_<wbr>radius</th>")


def test_refused_combinations_are_counted_on_it(made: Path) -> None:
    text = made.read_text()
    assert "Combinations passed over: 6" in text
    assert "6 x Cells of 40 mm are larger than" in text


@pytest.mark.slow
def test_the_same_study_has_the_same_page_but_for_times(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page_module, "plots_of", lambda *_: [])

    def without_times(path: Path) -> str:
        study = dataclasses.replace(STUDY, do=("forecast",), front=None)
        page = volfrep.sweep(study, path).page.read_text()
        return "".join(line.rsplit("<td", 2)[0] for line in page.splitlines())

    assert without_times(tmp_path / "one") == without_times(tmp_path / "two")


def test_only_figures_that_are_there_are_plotted(tmp_path: Path) -> None:
    study = dataclasses.replace(STUDY, do=("properties",), front=None)
    assert choose_plots(volfrep.sweep(study, tmp_path).table, study) == []


@pytest.mark.slow
def test_a_picture_of_the_chosen_is_in_the_page(tmp_path: Path) -> None:
    pytest.importorskip("pyvista", reason="pictures need the optional package pyvista")
    front = Front({"forecast.mass_g": "least"}, ("picture",), 1)
    study = dataclasses.replace(STUDY, front=front, do=("forecast",))
    page = Page(volfrep.sweep(study, tmp_path, workers=1).page.read_text())
    (picture,) = (image for image in page.images if image.startswith("data:image/jpeg"))
    assert base64.b64decode(picture.split(",")[1])[:2] == b"\xff\xd8"
