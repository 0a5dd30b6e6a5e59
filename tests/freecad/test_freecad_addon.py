# SPDX-License-Identifier: LGPL-2.1-or-later
"""What FreeCAD and the Addon Manager find in this folder."""

import ast
import os
import re
import shlex
import shutil
import subprocess
import sys
import zipfile
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
        "exec(open('Init.py').read()); assert len(observers) == 2;"
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
    assert deps.missing_optional() == []


def test_install_takes_only_what_the_index_allows(monkeypatch):
    """The Install button and the Addon Manager install the same, but for the optional ones."""
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    from index_review import ALLOWED

    assert set(deps.PACKAGES.values()) - set(deps.OPTIONAL) <= ALLOWED
    assert not ALLOWED & set(deps.OPTIONAL)


def test_the_command_is_for_this_python(monkeypatch):
    find = deps.importlib.util.find_spec
    hidden = {"manifold3d", "trimesh"}
    for name in hidden:
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.setattr(
        deps.importlib.util, "find_spec", lambda name: None if name in hidden else find(name)
    )
    assert deps.missing_packages() == ["trimesh"]
    assert deps.missing_optional() == ["manifold3d"]
    missing = ["trimesh", "manifold3d"]
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


@pytest.fixture(scope="module")
def addon_manager():
    """The folder of FreeCAD's own Add-on Manager, where it can be driven without its window."""
    homes = (App.getHomePath(), App.getResourceDir())
    folders = [Path(home) / "Mod" / "AddonManager" for home in homes]
    folder = next((f for f in folders if (f / "addonmanager_installer.py").is_file()), None)
    if folder is None:
        pytest.skip("the Add-on Manager of this FreeCAD has its window only")
    return folder


def test_the_addon_manager_reads_what_it_is_and_needs(addon_manager, monkeypatch):
    monkeypatch.syspath_prepend(str(addon_manager))
    from Addon import Addon

    addon = Addon("VOLFREP", str(ROOT), Addon.Status.NOT_INSTALLED, "main")
    addon.load_metadata_file(str(ROOT / "package.xml"))
    assert addon.contains_workbench()
    assert addon.python_requires | addon.python_optional == set(deps.PACKAGES.values())
    assert addon.python_optional == {"manifold3d"}


def test_the_addon_manager_puts_packages_where_this_freecad_looks(addon_manager, monkeypatch):
    monkeypatch.syspath_prepend(str(addon_manager))
    import addonmanager_utilities as utilities

    theirs = os.path.normpath(utilities.get_pip_target_directory())
    assert theirs == os.path.normpath(compat.package_folder())


#: Runs in a FreeCAD of its own, whose profile has no add-on.
INSTALL = """
import os, sys
sys.path.insert(0, {manager!r})
from Addon import Addon, MissingDependencies
from addonmanager_dependency_installer import DependencyInstaller
from addonmanager_installer import AddonInstaller, InstallationMethod
import addonmanager_freecad_interface as fci

class Console:  # it says why only in the log, which freecadcmd does not show
    def __getattr__(self, name):
        return lambda said, *_: print("SAID", said.rstrip())

fci.Console = Console()
# FreeCAD 1.1 uses git for the add-ons that are named, and asks a server for versions of packages.
preferences = fci.ParamGet("User parameter:BaseApp/Preferences/Addons")
preferences.SetString("force_git_in_repos", "VOLFREP")
preferences.SetString("pip_constraints_path", {constraints!r})
addon = Addon("VOLFREP", {url!r}, Addon.Status.NOT_INSTALLED, "main")
known = Addon("VOLFREP", {url!r}, Addon.Status.NOT_INSTALLED, "main")
known.load_metadata_file({metadata!r})  # which gives it the address in there
if hasattr(MissingDependencies, "import_from_addon"):
    wanted = MissingDependencies()
    wanted.import_from_addon(known, [])
else:  # FreeCAD 1.0
    wanted = MissingDependencies(known, [])
print("LACKS", sorted(wanted.python_requires))
packages = DependencyInstaller([], {packages!r}, [])
packages.failure.connect(lambda *said: print("PACKAGES", said))
packages.run()
installer = AddonInstaller(addon, allow_list=[])
installer.failure.connect(lambda _, said: print("SAID", said))
print("INSTALLED", installer.run(InstallationMethod[{method!r}]))
sys.stdout.flush()
os._exit(0)
"""

#: The next start of FreeCAD, with its window.
NEXT_START = """
import os, sys
import FreeCAD as App, FreeCADGui as Gui
said = []
try:
    Gui.activateWorkbench("VolfrepWorkbench")
    said.append("WORKBENCH " + Gui.activeWorkbench().MenuText)
    import {package} as workbench, probe_package
    from {package} import make_lattice_infill
    said.append("FROM " + workbench.__file__)
    said.append("PACKAGE " + probe_package.__file__)
    doc = App.newDocument("A")
    infill = make_lattice_infill(doc, doc.addObject("Part::Box", "B"), CellSize=5, ShellThickness=0)
    doc.recompute()
    said.append("STATUS " + infill.Status)
    App.closeDocument(doc.Name)
    sys.path.insert(0, {manager!r})
    from Addon import Addon
    from addonmanager_uninstaller import AddonUninstaller
    addon = Addon("VOLFREP", {url!r}, Addon.Status.NO_UPDATE_AVAILABLE, "main")
    said.append("UNINSTALLED " + str(AddonUninstaller(addon).run()))
finally:
    open({answer!r}, "w").write("\\n".join(said))
    os._exit(0)
"""


@pytest.mark.parametrize("method", ["ZIP", "GIT"])
def test_the_addon_manager_installs_it_from_this_machine(addon_manager, method, tmp_path):
    """The release's archive is unpacked, a bare repository of the checkout cloned, a package
    installed; the next FreeCAD has it, fills, and uninstalls it.
    """
    if method == "GIT" and shutil.which("git") is None:
        pytest.skip("git is not installed")
    url = tmp_path / "VOLFREP"
    if method == "ZIP":
        # An environment's own Python knows the engine; the archive must not need it.
        maker = ROOT / "tools" / "addon_archive.py"
        subprocess.run([ROOT / ".venv" / "bin" / "python", maker, url], check=True)
        (url,) = tmp_path.glob("VOLFREP-*.zip")
    else:
        copy_of_the_sources(tmp_path / "sources")
        made_bare(tmp_path / "sources", url)
    home = tmp_path / "home"
    (home / "Mod").mkdir(parents=True)
    there = home / compat.package_folder().relative_to(App.getUserAppDataDir())
    there.mkdir(parents=True)
    for package in Path(App.getUserAppDataDir(), "AdditionalPythonPackages").iterdir():
        if "volfrep" not in package.name:  # the engine is the add-on's own
            (there / package.name).symlink_to(package.resolve())
    wheel = probe_wheel(tmp_path)
    constraints = tmp_path / "constraints" / f"3.{sys.version_info.minor}" / "constraints.txt"
    constraints.parent.mkdir(parents=True)
    constraints.write_text("")
    code = INSTALL.format(
        manager=str(addon_manager),
        url=str(url),
        method=method,
        metadata=str(ROOT / "package.xml"),
        constraints=str(tmp_path / "constraints"),
        packages=[str(wheel)],
    )
    environment = dict(
        os.environ, FREECAD_USER_HOME=str(home), PYTHONPATH="", PIP_NO_INDEX="1", LC_ALL="C.UTF-8"
    )
    script = tmp_path / "script.py"
    script.write_text(code, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, str(script)], env=environment, capture_output=True, text=True, timeout=600
    )
    assert "INSTALLED True" in done.stdout, done.stdout + done.stderr
    # FreeCAD 1.0 looks for a module of the package's name.
    assert "LACKS []" in done.stdout or "LACKS ['scikit-image']" in done.stdout, done.stdout
    assert "PACKAGES" not in done.stdout, done.stdout
    installed = home / "Mod" / "VOLFREP"
    assert (installed / "package.xml").is_file()
    assert (installed / ".git").exists() == (method == "GIT")

    answer = tmp_path / "answer"
    package = "freecad.volfrep" if method == "ZIP" else "freecad_volfrep"
    script.write_text(
        NEXT_START.format(
            answer=str(answer), package=package, manager=str(addon_manager), url=str(url)
        ),
        encoding="utf-8",
    )
    environment |= {"LIBGL_ALWAYS_SOFTWARE": "1", "QTWEBENGINE_DISABLE_SANDBOX": "1"}
    window = Path(sys.executable).with_name(Path(sys.executable).name.lower().replace("cmd", ""))
    done = subprocess.run(
        ["xvfb-run", "-a", str(window), str(script)], env=environment, capture_output=True,
        text=True, timeout=600,
    )  # fmt: skip
    assert answer.is_file(), done.stdout + done.stderr
    said = dict(line.split(" ", 1) for line in answer.read_text(encoding="utf-8").splitlines())
    assert said.get("WORKBENCH") == "VOLFREP", done.stdout + done.stderr
    assert Path(said["FROM"]).is_relative_to(installed)
    assert Path(said["PACKAGE"]).is_relative_to(there)
    assert said["STATUS"] == "Up to date"
    assert said["UNINSTALLED"] == "True"
    left = [path for path in home.rglob("*") if "volfrep" in path.name.lower()]
    assert left == []


def copy_of_the_sources(target):
    """What a clone of the repository holds, but for the tests and pictures."""
    left_out = shutil.ignore_patterns(".*", "build", "tests", "images", "__pycache__", "*.egg-info")
    shutil.copytree(ROOT, target, ignore=left_out)


def made_bare(sources, target):
    """A bare repository of those files, on the branch main."""
    author = ("-c", "user.name=Test", "-c", "user.email=test@example.org")
    for words in (
        ("init", "-q", "-b", "main"), ("add", "-A"), (*author, "commit", "-q", "-m", "All"),
        ("clone", "-q", "--bare", ".", str(target)),
    ):  # fmt: skip
        subprocess.run(["git", *words], cwd=sources, check=True)


def probe_wheel(folder):
    """A package of one empty module, for pip, which needs no index for it."""
    path = folder / "probe_package-1.0-py3-none-any.whl"
    info = "probe_package-1.0.dist-info"
    files = {
        "probe_package.py": "",
        f"{info}/METADATA": "Metadata-Version: 2.1\nName: probe_package\nVersion: 1.0\n",
        f"{info}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    files[f"{info}/RECORD"] = "".join(f"{name},,\n" for name in [*files, f"{info}/RECORD"])
    with zipfile.ZipFile(path, "w") as wheel:
        for name, text in files.items():
            wheel.writestr(name, text)
    return path
