# SPDX-License-Identifier: LGPL-2.1-or-later
"""The wheel as users install it: in clean environments of every Python that is found here.

    python tools/test_wheel.py build/release [3.12 ...]

In each: `pip install` of the wheel with what it needs, the command, a block, the examples in the
docstrings of the public names, how long `import volfrep` takes, and that uninstalling leaves
nothing. Pythons from 3.10 to 3.14 are looked for on the PATH and where pyenv and uv keep theirs;
which are not there is said.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

MINORS = range(10, 15)
#: `import volfrep` takes no longer, s.
IMPORT_SECONDS = 0.15
#: Runs in the environment.
CHECKS = """
import doctest, sys, time
begin = time.perf_counter()
import volfrep
took = time.perf_counter() - begin
assert "site-packages" in volfrep.__file__, volfrep.__file__
homes = {sys.modules[getattr(volfrep, name).__module__] for name in volfrep.__all__}
found = [doctest.testmod(module) for module in homes]
part = volfrep.block((2, 2, 2), cell="CVC", cell_size=10, strut_radius=1)
part.save("block.stl")
print(took, sum(one.attempted for one in found), sum(one.failed for one in found))
"""


def main() -> None:
    """Try the wheel; ends with 1 where something is not as it must be."""
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    (wheel,) = Path(sys.argv[1]).resolve().glob("volfrep-*.whl")
    wanted = sys.argv[2:] or [f"3.{minor}" for minor in MINORS]
    found = dict(pythons())
    failed = []
    for version in wanted:
        if version not in found:
            print(f"wheel: Python {version} is not on this machine: skipped", flush=True)
            continue
        begin = time.monotonic()
        wrong = try_in(found[version], wheel)
        took = time.monotonic() - begin
        print(f"wheel: Python {version}: {wrong or 'as it must be'} ({took:.0f} s)", flush=True)
        failed += [version] if not wrong.startswith("as it must be") else []
    if not set(wanted) & set(found):
        raise SystemExit("wheel: none of these Pythons is on this machine")
    if failed:
        raise SystemExit(f"wheel: not as it must be with Python {', '.join(failed)}")


def pythons() -> Iterator[tuple[str, str]]:
    """Each Python version that is here, and its interpreter, the first of each."""
    home = Path.home()
    folders = [
        Path(os.environ.get("PYENV_ROOT") or home / ".pyenv") / "versions",
        home / ".local" / "share" / "uv" / "python",
    ]
    for minor in MINORS:
        name = f"python3.{minor}"
        candidates = [shutil.which(name)]
        for folder in folders:
            candidates += sorted(map(str, folder.glob(f"*3.{minor}.*/bin/{name}")))
        for candidate in filter(None, candidates):
            # pyenv's own stand-ins answer for a version that is not chosen with an error.
            says = subprocess.run(
                [candidate, "-c", "import ensurepip, venv, sys; print(sys.version_info[1])"],
                capture_output=True, text=True,
            )  # fmt: skip
            if says.stdout.strip() == str(minor):
                yield f"3.{minor}", candidate
                break


def try_in(python: str, wheel: Path) -> str:
    """What is wrong with the wheel in a new environment of that Python."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        subprocess.run([python, "-m", "venv", folder / "env"], check=True)
        scripts = folder / "env" / ("Scripts" if os.name == "nt" else "bin")
        own = scripts / "python"
        environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}

        def run(*words: str | Path) -> str:
            done = subprocess.run(
                list(words), cwd=folder, env=environment, capture_output=True, text=True
            )
            if done.returncode:
                raise RuntimeError(f"{Path(words[0]).name} {words[1]}: {done.stdout}{done.stderr}")
            return done.stdout

        pip = (own, "-m", "pip", "--disable-pip-version-check")
        try:
            before = set(folder.rglob("*volfrep*"))
            run(
                *pip,
                "install",
                "--quiet",
                "--no-compile",
                "--only-binary",
                ":all:",
                f"{wheel}[spec]",
            )
            run(own, "-c", "import volfrep")  # compiled once
            took, tried, failures = run(own, "-c", CHECKS).splitlines()[-1].split()
            said = run(scripts / "volfrep", "--version")
            run(scripts / "volfrep", "block", "--cell", "FCC", "--cell-size", "10",
                "--strut-radius", "1", "--count", "2,2,2", "-o", "own.3mf")  # fmt: skip
            run(*pip, "uninstall", "--quiet", "--yes", "volfrep")
        except RuntimeError as error:
            return str(error)
        wrong = []
        if float(took) > IMPORT_SECONDS:
            wrong.append(f"import takes {float(took):.2f} s")
        if int(failures):
            wrong.append(f"{failures} of {tried} examples fail")
        if wheel.name.split("-")[1] not in said:
            wrong.append(f"--version says {said!r}")
        left = set(folder.rglob("*volfrep*")) - before
        if left:
            wrong.append(f"uninstalling leaves {sorted(map(str, left))}")
        facts = f"import {float(took):.3f} s, {tried} lines of examples"
        return "; ".join(wrong) or f"as it must be, {facts}"


if __name__ == "__main__":
    main()
