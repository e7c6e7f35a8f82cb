"""Child processes that may crash, hang or be killed, and the time that is left for them."""

from __future__ import annotations

import os
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass

_GRACE = 8  # seconds between the interruption of a process, which keeps what it finished, and its end by force
_LINES = 6  # of what a process said last
_LONGEST_LINE = 400

DONE, FAILED, OUT_OF_TIME, SKIPPED = "done", "failed", "out of time", "skipped"


class Clock:
    """Seconds that are left of a limit, none where it has passed."""

    def __init__(self, limit: float, outer: Clock | None = None):
        self._start, self._limit, self._outer = time.monotonic(), limit, outer

    @property
    def spent(self) -> float:
        return time.monotonic() - self._start

    @property
    def left(self) -> float:
        own = max(self._limit - self.spent, 0.0)
        return own if self._outer is None else min(own, self._outer.left)

    def part(self, limit: float) -> Clock:
        """A clock for a part of the work, which also ends with this one."""
        return Clock(limit, self)


@dataclass(frozen=True)
class Outcome:
    """How a process ended. `last` is what it said last, of errors alone where it named any; `code` is negative for a signal and
    None where it ran out of time."""

    status: str
    code: int | None
    seconds: float
    output: str
    last: str
    command: list[str]

    def record(self) -> dict:
        return {"status": self.status, "exit": self.code, "seconds": round(self.seconds, 2), "last": self.last,
                "command": self.command}


def _last(text: str) -> str:
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    errors = [line for line in lines if "error" in line.lower() or "failed" in line.lower()]
    return "\n".join(line[:_LONGEST_LINE] for line in (errors or lines)[-_LINES:])


def run(command: list[str], limit: float, accepted: tuple[int, ...] = (0,), cwd: str | None = None) -> Outcome:
    """Runs a command for at most `limit` seconds: then it is interrupted, and killed where it goes on all the same."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=errors, start_new_session=True, cwd=cwd)
        except OSError as error:
            return Outcome(FAILED, None, 0.0, "", f"{command[0]}: {error.strerror or error}", command)
        in_time = True
        try:
            code = process.wait(limit)
        except subprocess.TimeoutExpired:
            in_time = False
            code = _end(process)
        except BaseException:
            _end(process)
            raise
        out.seek(0)
        errors.seek(0)
        said, complained = (file.read().decode("utf-8", "replace") for file in (out, errors))
    status = OUT_OF_TIME if not in_time else DONE if code in accepted else FAILED
    last = _last(complained if complained.strip() else said)
    if code < 0 and in_time:
        last = "\n".join(filter(None, (last, f"ended by signal {-code} ({_signal_name(-code)})")))
    return Outcome(status, code if in_time else None, time.monotonic() - start, said, last, command)


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return "unknown"


def _end(process: subprocess.Popen) -> int:
    """Interrupts a process and all that it started, then kills it."""
    for number, patience in ((signal.SIGINT, _GRACE), (signal.SIGKILL, None)):
        try:
            os.killpg(process.pid, number)
            return process.wait(patience)
        except subprocess.TimeoutExpired:
            continue
        except ProcessLookupError:
            return process.wait()
    return process.wait()
