"""The C++ program, as this package calls it: it checks configs, renders, measures, and reports its errors itself."""

from __future__ import annotations

import functools
import json
import os
import signal
import subprocess
import tempfile
from collections.abc import Iterable
from types import SimpleNamespace
from typing import Any

from orchestration.errors import Failed, ProgramEnded

INTERRUPTED = 130
_SENT_BY_KERNEL = 0x80  # si_code of a terminal's Ctrl-C, which the whole process group gets


def option_words(options: SimpleNamespace, names: Iterable[str]) -> list[str]:
    """The options that were given, as the program takes them."""
    words: list[str] = []
    for name in names:
        value = getattr(options, name, None)
        if value is True:
            words.append(f"--{name.replace('_', '-')}")
        for text in value if isinstance(value, list) else [value] if isinstance(value, str) else []:
            words += [f"--{name.replace('_', '-')}", text]
    return words


def assignment(path: str, value: Any) -> str:
    """For --set."""
    return f"{path}={json.dumps(value, ensure_ascii=False)}"


class Program:
    """options: of a command that takes a config; they go to the program with each call."""

    def __init__(self, path: str, options: SimpleNamespace) -> None:
        self.path, self._options = path, options
        self._config = option_words(options, ("profile", "set", "only", "scenes"))
        self._device = option_words(options, ("tracer", "device"))
        self._run = option_words(options, ("resume", "dry_run", "quiet"))

    def replace(self, **options: Any) -> Program:
        """The same with other options."""
        return Program(self.path, SimpleNamespace(**{**vars(self._options), **options}))

    def plan(self, config: str) -> dict:
        """What a config asks for (docs/programs.md). @throws ProgramEnded where it can't be run."""
        return self._json("plan", config, *self._config)

    def jobs(self, config: str, more: Iterable[str]) -> list[dict]:
        """The parts of an experiment (docs/parts.md)."""
        return self._json("jobs", config, "--json", *self._config, *self._device, *more)["jobs"]

    def part_words(self, config: str) -> list[str]:
        """What `run` takes for each part of an experiment, as it was given."""
        return [config, *self._config, *self._device]

    @functools.cached_property
    def passes(self) -> dict[str, dict[str, dict]]:
        """The JSON Schema of each parameter by pass."""
        kinds = self._json("schema")["properties"]["graph"]["items"]["oneOf"]
        return {kind["properties"]["pass"]["const"]:
                {name: schema for name, schema in kind["properties"].items() if name not in ("pass", "id", "inputs")}
                for kind in kinds}

    def run(self, config: str, out: str, more: Iterable[str] = ()) -> int:
        """Runs a config with the options of the command. @return the exit status: 0, or 1 where a variant failed.
        @throws ProgramEnded where it was wrong or interrupted."""
        return self._wait([self.path, "run", config, *self._config, *self._device, *self._run, "--out", out, *more])

    def run_quietly(self, config: str, out: str, scenes: str, more: Iterable[str]) -> int:
        """Runs a config that a command wrote. Prints nothing of its output but a mistake."""
        words = [self.path, "run", config, "--scenes", scenes, *self._device, "--quiet", "--no-report", "--out", out, *more]
        with tempfile.TemporaryFile("w+", errors="surrogateescape") as said:
            try:
                return self._wait(words, said)
            except ProgramEnded as ended:
                if ended.status != INTERRUPTED:
                    said.seek(0)
                    lines = said.read().strip().splitlines() or ["the program refused a trial"]
                    os.write(2, (lines[-1] + "\n").encode("utf-8", "surrogateescape"))
                raise

    def export_scene(self, config: str, target: str, changes: Iterable[str], frame: int | None = None) -> None:
        """Writes what a config renders as glTF, after these changes of the form PATH=VALUE: the scene at its time, or in a frame.
        @throws ProgramEnded where it is wrong."""
        words = [word for change in changes for word in ("--set", change)] + ([] if frame is None else ["--frame", str(frame)])
        done = subprocess.run([self.path, "export-scene", config, target, *option_words(self._options, ("profile", "scenes", "set")), *words],
                              stdout=subprocess.DEVNULL, check=False)
        if done.returncode != 0:
            raise ProgramEnded(done.returncode)

    def _json(self, *words: str) -> Any:
        done = subprocess.run([self.path, *words], stdout=subprocess.PIPE, check=False)
        if done.returncode != 0:
            raise ProgramEnded(done.returncode)
        return json.loads(done.stdout)

    @staticmethod
    def _wait(words: list[str], said=None) -> int:
        """Waits for a run, which ends in its own way at an interrupt: this process goes on until then.

        A terminal sends Ctrl-C to both; what another process sends goes to this one, which hands it on."""
        awaited = {signal.SIGINT, signal.SIGTERM, signal.SIGCHLD}
        before = signal.pthread_sigmask(signal.SIG_BLOCK, awaited)
        try:
            child = subprocess.Popen(words, stdout=said, stderr=said,
                                     preexec_fn=lambda: signal.pthread_sigmask(signal.SIG_SETMASK, before))
            while (status := child.poll()) is None:
                info = signal.sigwaitinfo(awaited)
                if info.si_signo != signal.SIGCHLD and info.si_code != _SENT_BY_KERNEL:
                    child.send_signal(info.si_signo)
        except OSError as error:
            raise Failed(f"can't run {words[0]}: {error.strerror}") from error
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        if status not in (0, 1):
            raise ProgramEnded(status if status > 0 else 128 - status)
        return status
