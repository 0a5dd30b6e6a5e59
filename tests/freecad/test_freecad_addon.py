# SPDX-License-Identifier: LGPL-2.1-or-later
"""What FreeCAD and the Addon Manager find in this folder."""

import ast
import re
import shlex
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import FreeCAD as App
import pytest
import tomllib

import freecad_volfrep
from conftest import said_without_packages
from freecad_volfrep import compat, deps

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def metadata():
    return App.Metadata(str(ROOT / "package.xml"))


def test_package_xml_says_what_the_addon_manager_needs(metadata):
    assert metadata.Name == "VOLFREP"
    assert metadata.Description
    oldest = getattr(metadata, "FreeCADMin", None)
    assert str(oldest).startswith("0.20")
    assert metadata.License[0]["name"] == "LGPL-2.1-or-later"
    assert (ROOT / metadata.License[0]["file"]).is_file()
    assert (ROOT / metadata.Icon).is_file()
    assert metadata.supportsCurrentFreeCAD()
    workbench = metadata.Content["workbench"][0]
    assert (ROOT / workbench.Icon).is_file()
    assert f"class {workbench.Classname}(" in (ROOT / "InitGui.py").read_text(encoding="utf-8")


def test_package_xml_agrees_with_the_engine(metadata):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert metadata.Version == project["version"]
    wanted = {requirement.split(">")[0] for requirement in project["dependencies"]}
    # FreeCAD 0.20 knows no kinds of dependency.
    listed = {d["package"] for d in metadata.Depend if d.get("type", "python") == "python"}
    assert listed == wanted == set(deps.PACKAGES.values())


def test_package_xml_says_where_the_addon_lives(metadata):
    places = {url["type"]: url for url in metadata.Urls}
    assert places.keys() == {"repository", "bugtracker", "readme", "documentation"}
    assert places["repository"]["branch"] == "main"
    home = places["repository"]["location"]
    for kind, place in places.items():
        assert place["location"].startswith(home), kind
    for kind in ("readme", "documentation"):
        _, _, file = places[kind]["location"].partition("/blob/main/")
        assert (ROOT / file).is_file()
    assert all(person["name"] for person in [*metadata.Maintainer, *metadata.Author])
    assert "lattice" in metadata.Content["workbench"][0].Tag


ICONS = sorted(freecad_volfrep.ICONS.glob("*.svg"))


@pytest.mark.parametrize("icon", ICONS, ids=lambda icon: icon.stem)
def test_icons_are_drawings_that_show_on_light_and_dark(icon):
    root = ElementTree.parse(icon).getroot()
    assert root.get("viewBox") == "0 0 64 64"
    for part in root.iter():
        # What is filled is seen by its filling, and so is a line of class "inside" on it; all
        # other lines stand on the background itself.
        line = part.get("stroke") and part.get("fill") in (None, "none")
        if line and part.get("class") != "inside":
            for background in ("#f0f0f0", "#2b2b2b"):
                assert contrast(part.get("stroke"), background) > 2, part.attrib


def test_every_icon_is_used_and_every_used_one_is_there():
    sources = [*(ROOT / "freecad_volfrep").rglob("*.py"), ROOT / "InitGui.py"]
    named = set()
    for source in sources:
        named |= set(re.findall(r"([\w-]+)\.svg", source.read_text(encoding="utf-8")))
    assert named == {icon.stem for icon in ICONS}


def contrast(one, two):
    """Of two colours as #rrggbb, as the WCAG defines it: from 1 to 21."""
    dark, light = sorted((luminance(one), luminance(two)))
    return (light + 0.05) / (dark + 0.05)


def luminance(colour):
    values = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in values]
    return sum(w * v for w, v in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def test_the_start_of_freecad_imports_nothing_heavy():
    """Init.py and the import of the package must not cost every start of FreeCAD time."""
    code = (
        f"import sys, types; sys.path.insert(0, {str(ROOT)!r});"
        "app = sys.modules['FreeCAD'] = types.ModuleType('FreeCAD');"
        "observers = []; app.addDocumentObserver = observers.append;"
        "exec(open('Init.py').read()); assert len(observers) == 1;"
        "import freecad_volfrep; heavy = {'numpy', 'scipy', 'skimage', 'trimesh', 'volfrep'};"
        "sys.exit(str(heavy & set(sys.modules)) if heavy & set(sys.modules) else 0)"
    )
    python = deps.python_executable()
    done = subprocess.run([python, "-c", code], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_the_engine_is_the_one_beside_the_workbench():
    import volfrep.util.errors

    assert Path(volfrep.util.errors.__file__).is_relative_to(ROOT / "core")


def test_scikit_image_imports_inside_freecad():
    compat.repair_lazy_loader()
    import skimage.measure

    assert skimage.measure.marching_cubes
    import lazy_loader.lazy_loader  # FreeCAD's own, which its CAM workbench needs

    assert lazy_loader.lazy_loader.LazyLoader


def test_version_is_numbers():
    assert (0, 20) <= compat.version() < (100, 0)


def test_packages_go_where_freecad_looks(monkeypatch):
    home = Path(App.getUserAppDataDir())
    monkeypatch.setattr(compat, "version", lambda: (0, 20))
    assert compat.package_folder() == home / "AdditionalPythonPackages"
    for newer in ((1, 0), (1, 1), (26, 3)):
        monkeypatch.setattr(compat, "version", lambda newer=newer: newer)
        name = f"py3{sys.version_info.minor}"
        assert compat.package_folder() == home / "AdditionalPythonPackages" / name


def test_nothing_is_missing_here():
    assert deps.missing_packages() == []


def test_the_command_is_for_this_python(monkeypatch):
    find = deps.importlib.util.find_spec
    hidden = {"manifold3d", "trimesh"}
    for name in hidden:
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.setattr(
        deps.importlib.util, "find_spec", lambda name: None if name in hidden else find(name)
    )
    missing = deps.missing_packages()
    assert missing == ["trimesh", "manifold3d"]
    monkeypatch.setattr(deps, "_installed", lambda name: name not in missing)
    words = shlex.split(deps.install_command(missing))
    python = words[0]
    version = subprocess.check_output([python, "-c", "import sys; print(sys.version)"], text=True)
    assert version.strip() == sys.version
    assert words[1:5] == ["-m", "pip", "install", "--target"]
    assert words[5] == str(compat.package_folder())
    assert {"trimesh", "manifold3d"} <= set(words)
    import numpy

    assert f"numpy=={numpy.__version__}" in words
    sentence = deps.explain_missing(missing)
    assert "trimesh, manifold3d" in sentence
    assert deps.install_command(missing) in sentence


def test_the_workbench_loads_without_the_packages(tmp_path):
    """In a FreeCAD whose profile has no packages: import, make an object, read what it says."""
    lines = said_without_packages(
        tmp_path,
        "from freecad_volfrep import make_lattice_infill\n"
        "doc = App.newDocument('A')\n"
        "box = doc.addObject('Part::Box', 'B')\n"
        "obj = make_lattice_infill(doc, box)\n"
        "doc.recompute()\n"
        "print('STATUS', obj.isValid(), obj.getStatusString())\n",
    )
    assert lines["STATUS"].startswith("STATUS False VOLFREP needs the Python packages")
    assert f"--target {tmp_path}" in lines["STATUS"]


def test_nothing_without_windows_imports_the_gui_at_its_top():
    for path in (ROOT / "freecad_volfrep").rglob("*.py"):
        if "gui" in path.relative_to(ROOT).parts:
            continue
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            names = [alias.name for alias in getattr(node, "names", [])]
            module = getattr(node, "module", "") or ""
            assert not any("FreeCADGui" in name or "PySide" in name for name in [*names, module])
            assert ".gui" not in module


def test_the_addon_manager_reads_what_it_is_and_needs(monkeypatch):
    """FreeCAD's own Add-on Manager, where it can be driven without its window."""
    homes = (App.getHomePath(), App.getResourceDir())
    folders = [Path(home) / "Mod" / "AddonManager" for home in homes]
    folder = next((f for f in folders if (f / "addonmanager_installer.py").is_file()), None)
    if folder is None:
        pytest.skip("the Add-on Manager of this FreeCAD has its window only")
    monkeypatch.syspath_prepend(str(folder))
    from Addon import Addon

    addon = Addon("VOLFREP", str(ROOT), Addon.Status.NOT_INSTALLED, "main")
    addon.load_metadata_file(str(ROOT / "package.xml"))
    assert addon.contains_workbench()
    assert addon.python_requires == set(deps.PACKAGES.values())
