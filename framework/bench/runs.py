"""Runs of a config by the program, and what its result files hold: whole, partly, or a failure."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from bench import processes
from bench.processes import Clock, Outcome

SHORTEST = 3  # seconds: less is no time to run anything in
_ALONE = 30  # seconds that a variant gets on its own
_PATIENCE = 3  # so many that fail on their own, one after the other, and the rest is left alone
_FINISHED = (0, 1)  # 1: some variant failed, which results.csv tells


@dataclass(frozen=True)
class Program:
    """The voxray program, and what every run of it is told."""

    path: Path
    configs: Path
    device: str
    scenes: Path | None
    profile: str

    def call(self, *arguments: str, limit: float, accepted: tuple[int, ...] = (0,), progress: Callable[[], float] | None = None) -> Outcome:
        return processes.run([str(self.path), *arguments], limit, accepted, progress)

    def profile_of(self, config: str, own: str = "") -> list[str]:
        """The profile that a config is to have if one is named, else the wanted one, `small` where the config does not have it; none
        for "full"."""
        if (own or self.profile) == "full":
            return []
        if own:
            return ["--profile", own]
        _, _, profiles = (self.configs / config).read_text(encoding="utf-8").partition("\nprofiles:")
        known = re.findall(r"^  ([\w-]+):", profiles, re.M)
        return next((["--profile", name] for name in (self.profile, "small") if name in known), [])


@dataclass(frozen=True)
class Variant:
    """What a run knows of one variant: `result` is its result.json, None with an `error` where it failed or did not run."""

    name: str  # its id, also of its folder and of its part
    graph: list[dict]  # its passes with all their parameters
    result: dict | None
    error: str
    alone: bool = False  # ran in a process of its own, after others

    @property
    def kinds(self) -> dict[str, str]:
        """Of its passes, by id."""
        return {str(entry.get("id", entry.get("pass"))): str(entry.get("pass")) for entry in self.graph}


@dataclass
class Run:
    """A config that was run, or that could not be."""

    name: str
    config: str
    tracer: str
    folder: Path
    outcome: Outcome
    variants: list[Variant] = field(default_factory=list)

    @property
    def status(self) -> str:
        if self.outcome.status == processes.DONE and any(variant.result is None for variant in self.variants):
            return processes.FAILED
        return self.outcome.status

    @property
    def device(self) -> str:
        return next((v.result.get("device", "") for v in self.variants if v.result), "")

    def variant(self, name: str) -> Variant | None:
        return next((variant for variant in self.variants if variant.name == name), None)

    def image(self, variant: Variant) -> Path | None:
        """A variant's indirect light, in which methods differ, else the whole image."""
        folder = (_alone_of(self.folder) if variant.alone else self.folder) / "images" / variant.name
        return next((path for path in (folder / "indirect.exr", folder / "final.exr") if variant.result and path.is_file()), None)

    def record(self) -> dict:
        failed = [{"variant": v.name, "error": v.error} for v in self.variants if v.result is None]
        return {"name": self.name, "config": self.config, "tracer": self.tracer, **self.outcome.record(), "status": self.status,
                "variants": len(self.variants), "failed": failed, "alone": [v.name for v in self.variants if v.alone]}


def run_config(program: Program, config: str, name: str, out: Path, clock: Clock, *, tracer: str = "", device: str | None = None,
               profile: str = "", assignments: tuple[str, ...] = ()) -> Run:
    """Runs a config within the clock's time. What a crash or a lost device took with it runs again, a process a variant."""
    device = program.device if device is None else device
    arguments = [str(program.configs / config), *program.profile_of(config, profile), *(["--device", device] if device else []),
                 *(["--tracer", tracer] if tracer else []), *(["--scenes", str(program.scenes)] if program.scenes else [])]
    for assignment in assignments:
        arguments += ["--set", assignment]
    folder = out / "runs" / name
    if clock.left < SHORTEST:
        skipped = Outcome(processes.SKIPPED, None, 0.0, "", processes.NO_TIME, [str(program.path), "run", *arguments])
        return Run(name, config, tracer, folder, skipped)
    outcome = program.call("run", *arguments, "--out", str(folder), "--no-report", limit=clock.left, accepted=_FINISHED,
                           progress=lambda: len(list(folder.glob("images/*/result.json"))))
    if outcome.code == 2 and "no file" in outcome.last:
        outcome = Outcome(processes.SKIPPED, 2, outcome.seconds, outcome.output, outcome.last, outcome.command)
    run = Run(name, config, tracer, folder, outcome, read_variants(folder))
    if outcome.status in (processes.DONE, processes.FAILED):
        _run_rest_alone(program, run, arguments, clock)
    return run


def _run_rest_alone(program: Program, run: Run, arguments: list[str], clock: Clock) -> None:
    """Runs again what failed or did not come to run. References are in the cache by then."""
    folder = _alone_of(run.folder)
    failures = 0
    for i, variant in enumerate(run.variants):
        if variant.result or clock.left < SHORTEST or failures == _PATIENCE:
            continue
        done = program.call("run", *arguments, "--out", str(folder), "--no-report", "--part", f"variant.{variant.name}",
                            limit=min(clock.left, _ALONE))
        found = next((v for v in read_variants(folder) if v.name == variant.name and v.result), None)
        result = found.result if found else None
        failures = 0 if result else failures + 1
        run.variants[i] = Variant(variant.name, variant.graph, result, "" if result else done.last or variant.error, True)


def _alone_of(folder: Path) -> Path:
    return folder.with_name(f"{folder.name}.alone")


def read_variants(folder: Path) -> list[Variant]:
    """The variants that the manifest plans, in its order; none where there is no manifest."""
    manifest = read_json(folder / "manifest.json")
    errors = {row["variant"]: row.get("error", "") for row in read_csv(folder / "results.csv")}
    variants = []
    for name, graph in (manifest.get("variants") or {}).items():
        result = read_json(folder / "images" / name / "result.json") or None
        variants.append(Variant(name, [entry for entry in graph if isinstance(entry, dict)], result, "" if result else errors.get(name) or "did not run"))
    return variants


def read_json(path: Path) -> dict:
    """A JSON object, empty where the file is absent or broken."""
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
        return value if isinstance(value, dict) else {}
    except (OSError, ValueError):
        return {}


def read_csv(path: Path) -> list[dict]:
    """Rows by column, none where the file is absent or broken."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    except (OSError, ValueError, csv.Error):
        return []
