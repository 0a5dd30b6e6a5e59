# SPDX-License-Identifier: LGPL-2.1-or-later
"""What was renamed works for two minor versions with a warning, then is refused."""

import pytest

import volfrep
from volfrep.cli.parser import with_current_options
from volfrep.util import deprecation
from volfrep.util.deprecation import NAMES, PARAMETERS, Renamed, minor
from volfrep.util.version import VERSION


@pytest.fixture
def changed(monkeypatch):
    """A parameter and a public name that were called otherwise before 0.1."""
    monkeypatch.setitem(PARAMETERS, "radius_of_struts", Renamed("strut_radius", "0.1"))
    monkeypatch.setitem(NAMES, "make_block", Renamed("block", "0.1"))
    return "'radius_of_struts' is called 'strut_radius' since version 0.1, and is refused 2 minor"


def test_a_keyword(changed):
    with pytest.warns(DeprecationWarning, match=changed):
        part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, radius_of_struts=0.7)
    assert part.spec.strut_radius == 0.7


def test_a_key_of_a_file(changed, tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text('cell = "BCC"\ncell_size = 10.0\nradius_of_struts = 0.7\nshell = 0.0\n')
    with pytest.warns(DeprecationWarning, match=changed):
        assert volfrep.read_spec(path).strut_radius == 0.7


def test_an_option(changed, capsys):
    given = ["block", "--radius-of-struts=0.7", "--cell-size", "10", "-o", "x.stl"]
    assert with_current_options(given) == ["block", "--strut-radius=0.7", *given[2:]]
    assert "warning: '--radius-of-struts' is called '--strut-radius'" in capsys.readouterr().err


def test_a_name_of_the_package(changed):
    with pytest.warns(DeprecationWarning, match="'make_block' is called 'block'"):
        assert volfrep.make_block is volfrep.block


@pytest.mark.parametrize(("version", "works"), [("0.1.0", True), ("0.2.9", True), ("0.3.0", False)])
def test_it_ends_after_two_minor_versions(changed, version, works, monkeypatch):
    monkeypatch.setattr(deprecation, "VERSION", version)
    if works:
        with pytest.warns(DeprecationWarning, match="make_block"):
            assert deprecation.current_name("make_block", NAMES) == "block"
    else:
        with pytest.raises(volfrep.VolfrepError, match="'make_block' is called 'block' now"):
            deprecation.current_name("make_block", NAMES)


def test_what_has_ended_is_taken_out_of_the_tables():
    """One minor version after the last one in which it worked, its row goes, too."""
    for row in [*PARAMETERS.values(), *NAMES.values()]:
        assert minor(VERSION) <= minor(row.since) + deprecation.MINOR_VERSIONS


def test_a_file_of_a_later_schema_is_refused(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text('schema = 1\ncell = "BCC"\n')
    assert volfrep.read_spec(path).cell.name == "BCC"
    path.write_text('schema = 2\ncell = "BCC"\n')
    with pytest.raises(volfrep.VolfrepError, match=r"has the schema 2.*reads 1: update"):
        volfrep.read_spec(path)
