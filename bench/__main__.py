# SPDX-License-Identifier: LGPL-2.1-or-later
"""``python -m bench``: measure, keep the results as JSON, and write the document from them.

Exit code 1 when an experiment, or a job of ours in one, did not work; missed bars do not count.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
import traceback
from pathlib import Path
from typing import Any

from .document import document
from .experiments import EXPERIMENTS
from .measuring import ROOT, Context, machine
from .readme import NEEDED, figures_table, write_into

#: Seconds that one job of another tool may take.
PEER_LIMIT, QUICK_PEER_LIMIT = 90.0, 60.0
#: Minutes after which other tools are left out, so that a slow machine ends all the same
#: (`--peer-minutes` gives them more).
PEER_MINUTES, QUICK_PEER_MINUTES = 16.0, 3.5
#: Files with more triangles are not read back: welding takes 2 s a million, and 0.4 GB.
MOST_TRIANGLES, QUICK_MOST_TRIANGLES = 8_000_000, 3_000_000


def measure(names: list[str], quick: bool, results: Path, peer_minutes: float) -> None:
    """Run experiments one by one; each one's result is on disk before the next begins."""
    results.mkdir(parents=True, exist_ok=True)
    peers_until = time.monotonic() + 60.0 * peer_minutes
    for name in names:
        print(f"{name}:", flush=True)
        about = machine()
        start = time.perf_counter()
        # In build, not in /tmp, which may lie in memory and would then be measured with it.
        with tempfile.TemporaryDirectory(dir=results) as folder:
            context = Context(
                quick=quick,
                folder=Path(folder),
                seconds_for_peers=QUICK_PEER_LIMIT if quick else PEER_LIMIT,
                most_triangles=QUICK_MOST_TRIANGLES if quick else MOST_TRIANGLES,
                peers_until=peers_until,
            )
            try:
                result: dict[str, Any] = EXPERIMENTS[name].measure(context)
            except Exception as error:  # the other experiments still run
                traceback.print_exc()
                result = {"error": f"{type(error).__name__}: {error}"}
        result |= {"machine": about, "seconds": time.perf_counter() - start, "quick": quick}
        (results / f"{name}.json").write_text(json.dumps(result, indent=1), encoding="utf-8")
        print(f"    {result['seconds']:.0f} s", flush=True)


def failures(result: Any) -> list[str]:
    """Why an experiment or jobs of ours in it did not work."""
    if isinstance(result, dict):
        own = [str(result["error"])] if "error" in result else []
        own += [str(result.get("note"))] if result.get("failed") else []
        return own + [found for value in result.values() for found in failures(value)]
    if isinstance(result, list):
        return [found for value in result for found in failures(value)]
    return []


def main() -> int:
    """Do what the arguments say."""
    parser = argparse.ArgumentParser(prog="bench", description="The benchmark of VOLFREP.")
    part = parser.add_mutually_exclusive_group()
    part.add_argument("--quick", action="store_true", help="a small part, into build/bench-quick")
    part.add_argument(
        "--readme", action="store_true",
        help="only what the README's table tells of, without other tools; nothing else is written",
    )  # fmt: skip
    parser.add_argument(
        "--only", nargs="+", choices=EXPERIMENTS, metavar="NAME",
        help=f"some of {', '.join(EXPERIMENTS)}; the others' last results are kept",
    )  # fmt: skip
    parser.add_argument(
        "--peer-minutes", type=float, metavar="MINUTES",
        help=f"when other tools are left out ({PEER_MINUTES:g}; quick {QUICK_PEER_MINUTES:g})",
    )  # fmt: skip
    parser.add_argument(
        "--render-only", action="store_true", help="write the document from the last results"
    )
    options = parser.parse_args()
    kind = "-quick" if options.quick else "-readme" if options.readme else ""
    results = ROOT / "build" / f"bench{kind}"
    out = ROOT / "docs" / "benchmarks.md" if not kind else results / "benchmarks.md"
    if not options.render_only:
        minutes = {"": PEER_MINUTES, "-quick": QUICK_PEER_MINUTES, "-readme": 0.0}[kind]
        if options.peer_minutes is not None:
            minutes = options.peer_minutes
        names = options.only or (NEEDED if options.readme else EXPERIMENTS)
        measure(list(names), options.quick, results, minutes)
    found = {
        name: json.loads((results / f"{name}.json").read_text(encoding="utf-8"))
        for name in EXPERIMENTS
        if (results / f"{name}.json").exists()
    }
    text, broken = document(found, EXPERIMENTS, out.parent / "images" / "benchmarks")
    out.write_text(text, encoding="utf-8")
    print(f"written to {out}")
    if not options.quick and set(NEEDED) <= found.keys():
        write_into(ROOT / "README.md", figures_table(found))
        print("and its table into README.md")
    bad = {name: failures(result) for name, result in found.items() if failures(result)}
    for name, reasons in bad.items():
        print(f"{name}: {'; '.join(reasons)}", file=sys.stderr)
    return 1 if bad or broken else 0


if __name__ == "__main__":
    sys.exit(main())
