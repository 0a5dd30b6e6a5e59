# SPDX-License-Identifier: LGPL-2.1-or-later
"""What Windows and macOS ask of the sources and files, proved without them: docs/platforms.md."""

import ast
import ctypes
import errno
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import volfrep
from volfrep.util import files

ROOT = Path(__file__).resolve().parents[2]
SOURCES = sorted([*(ROOT / "core").rglob("*.py"), *(ROOT / "freecad_volfrep").rglob("*.py")])
#: Modules, and names of `os` and `signal`, that Windows does not have.
POSIX_MODULES = {"fcntl", "grp", "pty", "pwd", "resource", "termios", "tty"}
POSIX_NAMES = re.compile(
    r"\bos\.(fork|forkpty|getuid|geteuid|getpgid|killpg|mkfifo|nice|setsid|uname|wait4)\b"
    r"|\bsignal\.(SIGKILL|SIGALRM|SIGHUP|SIGUSR\d|alarm|pthread_kill)\b"
)
RESERVED = re.compile(r"(aux|con|nul|prn|com\d|lpt\d)(\..*)?", re.IGNORECASE)
#: Wine cannot follow paths that are longer than Windows once took; Windows does.
WINE = sys.platform == "win32" and hasattr(ctypes.windll.ntdll, "wine_get_version")
#: A folder as users have them: with spaces, other letters, and longer than that.
FOLDER = Path("My Parts", "Größe 10 µm, 試作", *["a folder of a long name"] * (0 if WINE else 9))


def test_no_file_is_taken_for_a_macro_of_the_user():
    """FreeCAD's Addon Manager copies all .FCMacro files of an add-on among the user's macros."""
    assert [name for name in known_files() if name.lower().endswith(".fcmacro")] == []


def known_files():
    """Files that git knows; in a copy without git, all but what is hidden or made."""
    if shutil.which("git"):
        done = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True)
        if done.returncode == 0:
            return [name for name in done.stdout.split("\0") if name]
    hidden = re.compile(r"\..*|build|__pycache__|.*\.egg-info")
    found = []
    for folder, below, files_in in os.walk(ROOT):
        # Not even looked into: Wine's own folder there holds a link to the whole system.
        below[:] = [name for name in below if not hidden.fullmatch(name)]
        found += [Path(folder, name) for name in files_in if not hidden.fullmatch(name)]
    return [path.relative_to(ROOT).as_posix() for path in found]


def test_no_two_files_differ_in_case_only_and_none_is_reserved():
    names = known_files()
    assert len({name.lower() for name in names}) == len(names)
    assert [name for name in names if RESERVED.fullmatch(name.rpartition("/")[2])] == []
    assert [name for name in names if re.search(r'[<>:"|?*\\]', name)] == []
    assert max(map(len, names)) < 120


def test_what_only_posix_has_stands_behind_a_guard():
    """Such a module is imported where its absence is caught; such a name is not used."""
    for path in SOURCES:
        text = path.read_text(encoding="utf-8")
        assert not POSIX_NAMES.search(text), path
        if not re.search(rf"\b({'|'.join(POSIX_MODULES)})\b", text):
            continue
        tree = ast.parse(text)
        guarded = {
            id(inner)
            for node in ast.walk(tree)
            if isinstance(node, ast.Try)
            and any("ImportError" in ast.unparse(h.type) for h in node.handlers if h.type)
            for inner in ast.walk(node)
        }
        for node in ast.walk(tree):
            if isinstance(node, (ast.Import, ast.ImportFrom)) and id(node) not in guarded:
                names = {alias.name for alias in node.names} | {getattr(node, "module", None)}
                assert not names & POSIX_MODULES, path


def test_no_process_is_forked():
    """Every worker is a program of its own, as `spawn` starts them, on every system."""
    for path in SOURCES:
        text = path.read_text(encoding="utf-8")
        if "multiprocessing" not in text and "ProcessPoolExecutor" not in text:
            continue
        for node in ast.walk(ast.parse(text)):
            names = {alias.name for alias in getattr(node, "names", ()) if hasattr(alias, "name")}
            names.add(getattr(node, "module", None) or "")
            assert not any(name.split(".")[0] == "multiprocessing" for name in names), path
            assert "ProcessPoolExecutor" not in names, path


def test_files_lie_in_any_folder(tmp_path):
    folder = tmp_path / FOLDER
    folder.mkdir(parents=True)
    assert len(str(folder)) > 260 or WINE
    part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
    for name in ("Würfel 1.stl", "Würfel 2.3MF"):
        part.save(folder / name)
        assert volfrep.read_solid(folder / name).volume == pytest.approx(
            part.report.volume_mm3, rel=1e-4
        )
    volfrep.write_spec(part.spec, folder / "Würfel.toml")
    assert volfrep.read_spec(folder / "Würfel.toml") == part.spec


def test_a_worker_has_a_program_in_any_folder(tmp_path, monkeypatch):
    """The process beside this one is started with its files in such a folder."""
    import tempfile

    from volfrep.process.worker import Call, Worker, this_python

    folder = tmp_path.joinpath(*FOLDER.parts[:9])
    folder.mkdir(parents=True)
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    worker = Worker(this_python())
    try:
        assert worker.answer(Call("os:getpid", has_progress=False)) == worker.number
    finally:
        worker.end()


def test_line_ends_of_windows_are_read(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_bytes(b'cell = "BCC"\r\ncell_size = 7.5\r\n')
    assert volfrep.read_spec(path).cell_size == 7.5
    made = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
    made.save(tmp_path / "one.obj")
    (tmp_path / "two.obj").write_bytes((tmp_path / "one.obj").read_bytes().replace(b"\n", b"\r\n"))
    one, two = (volfrep.read_solid(tmp_path / name) for name in ("one.obj", "two.obj"))
    assert (one.vertices == two.vertices).all()
    assert (one.triangles == two.triangles).all()


def test_a_file_that_another_program_holds_open_is_named(tmp_path, monkeypatch):
    """Windows refuses to replace it: the old file stays, nothing else is left."""
    target = tmp_path / "part.stl"
    target.write_bytes(b"old")

    def refuse(*_):
        error = PermissionError(errno.EACCES, "Access is denied")
        error.winerror = 5
        raise error

    monkeypatch.setattr(files.os, "replace", refuse)
    with (
        pytest.raises(volfrep.VolfrepError, match=r"part\.stl"),
        files.replacing(target) as file,
    ):
        file.write(b"new")
    monkeypatch.undo()
    assert [path.name for path in tmp_path.iterdir()] == ["part.stl"]
    assert target.read_bytes() == b"old"


@pytest.mark.costly
@pytest.mark.skipif(os.name == "nt", reason="the locale is an environment variable elsewhere")
def test_text_is_utf_8_whatever_the_locale(tmp_path):
    """No file is read or written in the system's own encoding, which Windows has not in UTF-8."""
    code = (
        "import warnings, volfrep\n"
        "warnings.filterwarnings('error', category=EncodingWarning, module='volfrep')\n"
        "spec = volfrep.LatticeSpec(cell='BCC')\n"
        "volfrep.write_spec(spec, 'x.toml')\nassert volfrep.read_spec('x.toml') == spec\n"
        "volfrep.block((1, 1, 1), cell='BCC', cell_size=10, strut_radius=1).save('x.3mf')\n"
    )
    command = [sys.executable, "-X", "warn_default_encoding"]
    done = subprocess.run([*command, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
