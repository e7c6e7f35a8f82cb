"""`voxray stability`: runs every method in scenes that provoke one failure each, and holds each result against a limit."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from orchestration.errors import UsageError, did_you_mean
from orchestration.program import Program, assignment

MATRIX = Path(__file__).resolve().parents[2] / "configs" / "stability" / "matrix.yaml"
EVERY_METHOD = "every method"

Remedy = dict[str, dict[str, Any]]  # beginnings of methods' names, and for these a value by path


def named_axis(plan: dict, name: str, profile: str) -> dict[str, Any]:
    """An axis of the sweep that names its values."""
    axis = plan["config"].get("sweep", {}).get(name)
    if not axis or not isinstance(axis, dict):
        raise UsageError(f"{plan['place']}: profile '{profile}': its sweep needs an axis '{name}' that names its values")
    return axis


def check_names(names: list[str], known: list[str], what: str) -> None:
    for name in names:
        if name not in known:
            raise UsageError(f"no {what} '{name}'{did_you_mean(name, known)}")


def applies_to(beginning: str, method: str) -> bool:
    """Whether an entry of a remedy is for this method."""
    return beginning == EVERY_METHOD or method.startswith(beginning)


def change_chain(chain: Any, path: str, value: Any) -> tuple[Any, bool]:
    """Sets a parameter in a method's chain of passes. @return the chain, and whether a pass of it has the path's id."""
    owner, _, parameter = path.partition(".")
    passes = [{"pass": entry} if isinstance(entry, str) else dict(entry) for entry in (chain if isinstance(chain, list) else [chain])]
    own = [entry for entry in passes if entry.get("id", entry.get("pass")) == owner and parameter]
    for entry in own:
        entry[parameter] = value
    return (passes if isinstance(chain, list) else passes[0], True) if own else (chain, False)


def remedy_words(remedy: Remedy, methods: list[str], axis: dict[str, Any]) -> list[str]:
    """For --set, what a remedy changes for the methods: in their chains, where a pass there has the path's id, else in the
    config."""
    changed, words = copy.deepcopy(axis), []
    for beginning, own in remedy.items():
        if not any(applies_to(beginning, method) for method in methods):
            continue
        for path, value in own.items():
            is_in_chain = False
            for method in changed:
                if applies_to(beginning, method):
                    changed[method], is_own = change_chain(changed[method], path, value)
                    is_in_chain = is_in_chain or is_own
            if not is_in_chain:
                words.append(assignment(path, value))
    return words + ([assignment("sweep.method", changed)] if changed != axis else [])


class Matrix:
    """Profiles of a config, each with scenes of its own; methods are the same in all."""

    def __init__(self, program: Program, options: SimpleNamespace) -> None:
        self.program, self.options = program, options
        self.path = options.config or str(MATRIX)
        self.out = Path(options.out or "results/stability")

    def next_to(self, ending: str) -> Path:
        """A file next to the matrix: ".csv" of "matrix.yaml" is "matrix.csv"."""
        return Path(self.path).with_name(Path(self.path).stem + ending)

    def profiles(self) -> list[str]:
        return [self.options.profile] if self.options.profile else self.program.replace(set=[], only=[]).plan(self.path)["profiles"]

    def run(self, out: Path, profiles: list[str], methods: list[str], scenarios: list[str], remedy: Remedy | None = None) -> int:
        """Runs the profiles that have any scene that is asked for, with these scenes and methods, each into a folder of its
        own. A profile's first scene is what others are compared with: it stays where one of them does.
        @return the exit status"""
        scenes: dict[str, None] = {}
        known: dict[str, None] = {}
        runs: list[tuple[str, Program]] = []
        for profile in profiles:
            program = self.program.replace(profile=profile)
            plan = program.plan(self.path)
            scene_axis, method_axis = named_axis(plan, "scene", profile), named_axis(plan, "method", profile)
            scenes |= dict.fromkeys(scene_axis)
            known |= dict.fromkeys(method_axis)
            wanted = [name for name in scene_axis if not scenarios or name in scenarios]
            own = [name for name in method_axis if not methods or name in methods]
            if wanted and own:
                first = next(iter(scene_axis))
                only = [f"scene={name}" for name in dict.fromkeys([first, *wanted])] + [f"method={name}" for name in own]
                words = remedy_words(remedy, methods, method_axis) if remedy else []
                runs.append((profile, program.replace(only=self.options.only + only, set=self.options.set + words)))
        check_names(methods, list(known), "method")
        check_names(scenarios, list(scenes), "scenario")
        if not runs:
            raise UsageError(f"{self.path}: none of its profiles has that scene with that method")
        for _, program in runs:  # Nothing runs while any of them is wrong
            program.plan(self.path)
        status = 0
        for profile, program in runs:
            self.say(f"Profile {profile}")
            status = max(status, program.run(self.path, str(out / profile), ["--no-report"]))
        return status

    def run_remedies(self, failing: dict[str, dict[str, list[str]]]) -> int:
        """Runs what failed again, with the changes of each remedy, into remedies/REMEDY/METHOD/PROFILE."""
        status = 0
        remedies: dict[str, Remedy] = json.loads(self.next_to("_remedies.json").read_text(encoding="utf-8"))
        for name, remedy in remedies.items():
            for profile, methods in failing.items():
                for method, scenes in methods.items():
                    if any(applies_to(beginning, method) for beginning in remedy):
                        self.say(f"Remedy for {method}: {name}")
                        folder = self.out / "remedies" / name.replace(" ", "_") / method.replace(" ", "_")
                        status = max(status, self.run(folder, [profile], [method], scenes, remedy))
        return status

    def say(self, text: str) -> None:
        if not self.options.quiet:
            print(text, flush=True)


def main(program: Program, options: SimpleNamespace) -> int:
    matrix = Matrix(program, options)
    if options.export:
        from orchestration.stability_export import export

        count = export(program, matrix.path, matrix.next_to(".csv"), matrix.profiles(), options.scenario, Path(options.export))
        matrix.say(f"{count} scenes; matrix.yaml scores their images: {options.export}")
        return 0
    status = matrix.run(matrix.out, matrix.profiles(), options.method, options.scenario)
    if options.dry_run:
        return status

    from report import stability_page
    from report.results import ReportError

    try:
        tables = stability_page.write(matrix.out, matrix.next_to(".csv"))
        if options.remedies:
            status = max(status, matrix.run_remedies(tables.failing))
            tables = stability_page.write(matrix.out, matrix.next_to(".csv"), with_remedies=True)
    except ReportError as error:
        raise UsageError(f"stability: {error}") from error
    matrix.say(f"{tables.markdown}{tables.summary}\nPage: {matrix.out / 'stability.html'}")
    return status
