# SPDX-License-Identifier: LGPL-2.1-or-later
"""One version: what is written in several places is the same."""

import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy

import volfrep
from volfrep.util.version import VERSION, describe

ROOT = Path(__file__).resolve().parents[3]


def test_every_place_has_this_version_and_its_date():
    text = {
        name: (ROOT / name).read_text(encoding="utf-8")
        for name in ("package.xml", "CITATION.cff", "CHANGELOG.md", "pyproject.toml")
    }
    released = re.search(r"^## (\S+) \((.*)\)$", text["CHANGELOG.md"], re.MULTILINE)
    assert released is not None
    version, date = released.groups()
    package = ElementTree.fromstring(text["package.xml"])
    assert package.findtext("{*}version") == version
    assert package.findtext("{*}date") == date
    assert f"\nversion: {version}\n" in text["CITATION.cff"]
    assert f"\ndate-released: {date}\n" in text["CITATION.cff"]
    assert 'dynamic = ["version"]' in text["pyproject.toml"]
    assert volfrep.__version__ == VERSION == version


def test_the_command_says_its_version_and_its_packages_at_once():
    said = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "volfrep", "--version"], capture_output=True,
        text=True, check=True,
    )  # fmt: skip
    assert said.stdout.strip() == describe()
    assert said.stdout.startswith(f"volfrep {VERSION}\n")
    assert f"numpy {numpy.__version__}" in said.stdout
    for heavy in ("numpy", "scipy", "argparse"):
        assert not re.search(rf"\| +{heavy}$", said.stderr, re.MULTILINE), heavy


def test_the_page_of_promises_lists_every_public_name():
    text = (ROOT / "docs" / "promises.md").read_text(encoding="utf-8")
    listed = re.findall(r"`(\w+)`", text.partition("## Python")[2].partition("Their keywords")[0])
    assert sorted(listed) == sorted(volfrep.__all__)


def test_the_package_gives_the_addresses_of_the_workbench():
    """Of the package's metadata, which cannot read them from package.xml."""
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    listed = set(re.findall(r'^\w+ = "(https://.*)"$', project, re.MULTILINE))
    package = ElementTree.parse(ROOT / "package.xml").getroot()
    addresses = {url.get("type"): url.text for url in package.iter() if url.tag.endswith("url")}
    assert listed == {addresses[kind] for kind in ("repository", "documentation", "bugtracker")}
