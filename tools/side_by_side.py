# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the parts of ``make test`` side by side and say at the very end what failed.

    tools/side_by_side.py LANE... where a LANE is one or more "NAME=COMMAND", with "," between lanes

A lane's commands run one after the other, the lanes side by side; those named window-... have the
processor before the others, because a window that waits for its turn is not what is tested. What
a command says is in build/test/NAME.log; what it took of the processor is told, and its costliest
cases. One that fails is shown by its last lines when it ends, and last of all come all failed
checks by name: the lines that begin with FAILED or ERROR, which pytest and the window's scripts
write, and before them what held only at its second try (AGAIN).
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

LOGS = Path("build/test")
#: Lines of a failed command's output that are shown when it ends.
TAIL = 60
_said = threading.Lock()


@dataclass
class Part:
    """One command.

    Attributes:
        name: of its log.
        command: for the shell.
        code: with which it ended, or None.
        seconds: it took.
        processor: user and system seconds of all its processes that have ended.
        failures: what failed, where something did.
        again: what held only at its second try.
    """

    name: str
    command: str
    code: int | None = None
    seconds: float = 0.0
    processor: float = 0.0
    failures: list[str] = field(default_factory=list)
    again: list[str] = field(default_factory=list)

    @property
    def log(self) -> Path:
        """What it said."""
        return LOGS / f"{self.name}.log"

    @property
    def niceness(self) -> int:
        """By which others go before it."""
        return 0 if self.name.startswith("window-") else 10

    def run(self) -> None:
        """Run it, and tell how it ended."""
        start = time.monotonic()
        with self.log.open("wb") as log:
            process = subprocess.Popen(
                ["nice", "-n", str(self.niceness), "bash", "-c", self.command],
                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
            )  # fmt: skip
            _, status, usage = os.wait4(process.pid, 0)
        self.code = process.returncode = os.waitstatus_to_exitcode(status)
        self.seconds = time.monotonic() - start
        self.processor = usage.ru_utime + usage.ru_stime
        lines = self.log.read_text(encoding="utf-8", errors="replace").splitlines()
        self.again = [line for line in lines if line.startswith("AGAIN ")]
        if self.code:
            self.failures = failures_of(lines) or [
                f"left with {self.code}" + (" (time is over)" if self.code == 124 else "")
                + (f"; its last line: {lines[-1]}" if lines else "")
            ]  # fmt: skip
        with _said:
            print(f"{self.name}: {self.seconds:.0f} s, {self.processor:.0f} of the processor, "
                  + (f"FAILED (exit code {self.code})" if self.code else "passed"))  # fmt: skip
            shown = lines[-TAIL:] if self.code else costliest_of(lines)
            print("".join(f"    {line}\n" for line in shown), end="", flush=True)


def failures_of(lines: list[str]) -> list[str]:
    """The failed checks that a log names."""
    return [line for line in lines if re.match(r"(FAILED|ERROR) ", line)]


def costliest_of(lines: list[str]) -> list[str]:
    """The cases that tools/processor_time.py tells, and pytest's last line."""
    return [line for line in lines if re.match(r"\s*[\d.]+  \S+::", line)] + [
            line for line in lines[-1:] if " passed" in line]  # fmt: skip


def main(arguments: list[str]) -> int:
    """Returns 1 where a part failed."""
    LOGS.mkdir(parents=True, exist_ok=True)
    lanes: list[list[Part]] = [[]]
    for argument in arguments:
        if argument == ",":
            lanes.append([])
        else:
            lanes[-1].append(Part(*argument.split("=", 1)))

    def follow(lane: list[Part]) -> None:
        for part in lane:
            part.run()

    threads = [threading.Thread(target=follow, args=(lane,)) for lane in lanes]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    failed = [part for lane in lanes for part in lane if part.code != 0]
    for part in (part for lane in lanes for part in lane if part.again):
        print(f"\n{part.name} had a second try ({part.log}):")
        print("".join(f"    {line}\n" for line in part.again), end="")
    print(
        f"\n{sum(len(lane) for lane in lanes) - len(failed)} parts passed, {len(failed)} failed; "
        f"{sum(part.processor for lane in lanes for part in lane):.0f} s of the processor."
    )
    for part in failed:
        print(f"{part.name} ({part.log}):")
        for line in part.failures:
            print(f"    {line}")
    return 1 if failed else 0


if __name__ == "__main__":
    os.chdir(Path(__file__).resolve().parent.parent)
    sys.exit(main(sys.argv[1:]))
