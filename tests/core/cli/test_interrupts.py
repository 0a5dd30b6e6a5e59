# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command as a process: closed and full streams, readers that leave, Ctrl-C at any time."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

COMMAND = [sys.executable, "-m", "volfrep"]
BLOCK = ["block", "--count", "1,1,1", "--cell-size", "5", "--strut-radius", "0.5", "-o", "a.stl"]
INTERRUPTED = b"volfrep: Interrupted, no file was left half-written.\n"
needs_unix = pytest.mark.skipif(os.name == "nt", reason="streams of a Unix process")

#: The command, interrupted while it imports a module; compiled ones make another error of it.
IMPORTING = """
import os, signal, sys
import volfrep.__main__ as command

class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == MODULE:
            try:
                os.kill(os.getpid(), signal.SIGINT)
            except KeyboardInterrupt:
                if TURNED:
                    raise ImportError("half imported") from None
                raise

sys.meta_path.insert(0, Finder())
command.main()
"""

#: A command that leaves two objects that hold each other, and something to be done at the end.
LEAVING = """
import atexit
from volfrep.cli import interrupts

class Holder:
    def __del__(self):
        print("looked for")

interrupts.prepare()
atexit.register(print, "done at the end")
one, other = Holder(), Holder()
one.other, other.one = other, one
del one, other
interrupts.leave(3)
"""


def run(arguments, folder, **streams):
    return subprocess.run([*COMMAND, *arguments], cwd=folder, check=False, **streams)


def test_a_command_ends_at_once_and_does_what_is_left_to_do() -> None:
    left = subprocess.run(
        [sys.executable, "-c", LEAVING], capture_output=True, text=True, check=False
    )
    assert left.stdout.split("\n") == ["done at the end", ""], left.stderr
    assert left.returncode == 3


@pytest.mark.costly
@needs_unix
def test_a_full_standard_output_loses_text_and_no_file(tmp_path: Path) -> None:
    with open("/dev/full", "w", encoding="ascii") as full:
        done = run(BLOCK, tmp_path, stdout=full, stderr=subprocess.PIPE)
    assert done.returncode == 2
    assert done.stderr == (
        b"volfrep: Standard output took no more text (No space left on device).\n"
    )
    assert os.listdir(tmp_path) == ["a.stl"]


@needs_unix
@pytest.mark.parametrize("arguments", [["cells"], ["--help"], ["--version"], ["fill", "--help"]])
def test_a_full_standard_output_is_told_by_every_command(tmp_path: Path, arguments) -> None:
    with open("/dev/full", "w", encoding="ascii") as full:
        done = run(arguments, tmp_path, stdout=full, stderr=subprocess.PIPE)
    assert done.stderr.startswith(b"volfrep: Standard output took no more text")
    assert b"Traceback" not in done.stderr
    assert done.returncode == 2


@pytest.mark.costly
@pytest.mark.slow_but("0 1 2")
@needs_unix
@pytest.mark.parametrize("closed", ["1", "2", "0 1 2"])
def test_closed_streams_are_no_hindrance(tmp_path: Path, closed) -> None:
    """A closed stream's number would else be that of the next file that is opened."""
    code = f"import os, sys\nfor n in map(int, {closed!r}.split()): os.close(n)\n"
    code += f"os.execv(sys.executable, [sys.executable, '-m', 'volfrep', *{BLOCK!r}])"
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True)
    assert done.returncode == 0
    assert done.stderr == b""
    plain = run([*BLOCK[:-1], "b.stl"], tmp_path, capture_output=True)
    assert plain.returncode == 0
    assert (tmp_path / "a.stl").read_bytes() == (tmp_path / "b.stl").read_bytes()


@needs_unix
def test_a_reader_that_leaves_ends_no_job(tmp_path: Path) -> None:
    read, write = os.pipe()
    os.close(read)
    done = run(BLOCK, tmp_path, stdout=write, stderr=subprocess.PIPE)
    os.close(write)
    assert (done.returncode, done.stderr) == (0, b"")
    assert os.listdir(tmp_path) == ["a.stl"]


@needs_unix
@pytest.mark.parametrize(
    ("module", "turned"),
    [("argparse", False), ("volfrep.cli.command", False), ("numpy", False), ("numpy", True),
     ("skimage.measure", True)],
)  # fmt: skip
def test_ctrl_c_during_an_import_is_an_interruption(tmp_path: Path, module, turned) -> None:
    code = IMPORTING.replace("MODULE", repr(module)).replace("TURNED", str(turned))
    done = subprocess.run(
        [sys.executable, "-c", code, *BLOCK[:-1], "a.3mf"],
        cwd=tmp_path,
        capture_output=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert done.stderr == INTERRUPTED
    assert done.returncode == 130
    assert os.listdir(tmp_path) == []


@pytest.mark.costly
def test_warnings_of_libraries_are_not_for_the_user(tmp_path: Path) -> None:
    code = (
        "import sys, numpy as np, volfrep.__main__ as command, volfrep.design.cells as cells\n"
        "find = cells.find_cell\n"
        "def warned(*name):\n    np.float64(1.0) / np.zeros(1)\n    return find(*name)\n"
        "cells.find_cell = warned\n"
        "import volfrep.design.spec as spec\nspec.find_cell = warned\n"
        "command.main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, *BLOCK], cwd=tmp_path, capture_output=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.costly_cases("one thread")
@needs_unix
@pytest.mark.parametrize(
    ("limit", "told"),
    [(300_000_000, b"may take 0.3 GB of address space"), (410_000_000, b"")],
    ids=["too little", "one thread"],
)
def test_a_limit_of_the_address_space_is_told_before_numpy_is_loaded(
    tmp_path: Path, limit: int, told: bytes
) -> None:
    code = "import os, resource, sys\n"
    code += f"resource.setrlimit(resource.RLIMIT_AS, ({limit}, {limit}))\n"
    code += f"os.execv(sys.executable, [sys.executable, '-m', 'volfrep', *{BLOCK!r}])"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, timeout=60
    )
    assert done.returncode == (2 if told else 0), done.stderr
    assert told in done.stderr
    assert done.stderr.count(b"\n") <= 1, "one sentence"
    assert (tmp_path / "a.stl").exists() is not bool(told)
    assert run(["--version"], tmp_path, capture_output=True).returncode == 0


@needs_unix
def test_memory_that_is_not_to_be_had_is_told_with_its_limit(tmp_path: Path) -> None:
    """As of a job, of a thread that does not start, and of a library that finds no room."""
    for raised in (
        "MemoryError()",
        'RuntimeError("can\'t start new thread")',
        "ImportError('liblapack.so.3: failed to map segment from shared object')",
    ):
        code = "import resource, sys\nimport volfrep.cli.properties as properties\n"
        code += "resource.setrlimit(resource.RLIMIT_AS, (10**11, 10**11))\n"
        code += f"def fails():\n    raise {raised}\n"
        code += "properties._print_library = fails\nfrom volfrep.cli.command import run\n"
        code += "sys.exit(run(['cells']))"
        done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True)
        assert done.returncode == 2
        assert b"not enough memory for this job within the 100 GB of address" in done.stderr
        assert done.stderr.count(b"\n") == 1


@needs_unix
def test_free_memory_is_no_more_than_may_be_taken() -> None:
    code = "import resource\nfrom volfrep.design.memory_guard import free_memory\n"
    code += "resource.setrlimit(resource.RLIMIT_AS, (10**9, 10**9))\nprint(free_memory() < 0.95e9)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
    assert done.stdout == b"True\n"
