"""Child processes that may crash, hang or be killed, and the time that is left for them."""

from __future__ import annotations

import os
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass

_GRACE = 8  # seconds between the interruption of a process, which keeps what it finished, and its end by force
_PATIENCE = 40  # seconds that a process may take for one step
_POLL = 0.25  # seconds between looks at a process
_LINES = 6  # of what a process said last
_LONGEST_LINE = 400
_NOT_TOLD = ("voxray: warning:", "voxray: stopping;", "voxray: interrupted;")  # the outcome tells as much

NO_TIME = "no time was left"
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
    None where it had to be ended."""

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
    lines = [line.strip() for line in text.splitlines() if line.strip() and not line.startswith(_NOT_TOLD)]
    errors = [line for line in lines if "error" in line.lower() or "failed" in line.lower()]
    return "\n".join(line[:_LONGEST_LINE] for line in (errors or lines)[-_LINES:])


def run(command: list[str], limit: float, accepted: tuple[int, ...] = (0,), progress: Callable[[], float] | None = None,
        patience: float = _PATIENCE) -> Outcome:
    """Runs a command for at most `limit` seconds: then it is interrupted, and killed where it goes on all the same.

    @param progress How far the command is. Where that is more than 0 and stays what it is for `patience` seconds, the command has failed.
    """
    start = time.monotonic()
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=errors, start_new_session=True)
        except OSError as error:
            return Outcome(FAILED, None, 0.0, "", f"{command[0]}: {error.strerror or error}", command)
        try:
            code, why = _wait(process, limit, progress, patience)
        except BaseException:
            _end(process)
            raise
        out.seek(0)
        errors.seek(0)
        said, complained = (file.read().decode("utf-8", "replace") for file in (out, errors))
    status = OUT_OF_TIME if code is None and not why else DONE if code in accepted else FAILED
    if code is not None and code < 0:
        why = f"ended by signal {-code} ({_signal_name(-code)})"
    last = "\n".join(filter(None, (_last(complained if complained.strip() else said), why)))
    return Outcome(status, code, time.monotonic() - start, said, last, command)


def _wait(process: subprocess.Popen, limit: float, progress: Callable[[], float] | None,
          patience: float) -> tuple[int | None, str]:
    """The exit status, None where the process had to be ended; and why it was, unless its time was over."""
    clock, since, state = Clock(limit), Clock(patience), 0.0
    while clock.left > 0:
        try:
            return process.wait(min(clock.left, _POLL)), ""
        except subprocess.TimeoutExpired:
            pass
        if progress is None:
            continue
        if (now := progress()) != state:
            since, state = Clock(patience), now
        elif state > 0 and since.left == 0:
            _end(process)
            return None, f"got no further for {since.spent:.0f} s"
    _end(process)
    return None, ""


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return "unknown"


def _end(process: subprocess.Popen) -> None:
    """Interrupts a process and all that it started, then kills it. One that hangs in a driver may outlive even that."""
    for number in (signal.SIGINT, signal.SIGKILL):
        try:
            os.killpg(process.pid, number)
            process.wait(_GRACE)
            return
        except subprocess.TimeoutExpired:
            continue
        except ProcessLookupError:
            process.poll()
            return
