"""`voxray verify`: runs a packed study again, and says of each of its claims whether this machine confirms it."""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from orchestration import claims, packed_scenes, study_pack
from orchestration.errors import Failed, UsageError
from orchestration.pack import config_of
from orchestration.program import Program

NOT = "not"


def cache_folder() -> Path:
    """As framework/base/files.h has it."""
    if own := os.environ.get("VOXRAY_CACHE"):
        return Path(own)
    if common := os.environ.get("XDG_CACHE_HOME"):
        return Path(common) / "voxray"
    return Path.home() / ".cache" / "voxray"


@contextlib.contextmanager
def own_references(folder: Path) -> Iterator[None]:
    """References are rendered again, whatever is cached; compiled shaders stay."""
    shaders = cache_folder() / "spirv"
    folder.mkdir()
    shaders.mkdir(parents=True, exist_ok=True)
    (folder / "spirv").symlink_to(shaders.resolve())
    before = os.environ.get("VOXRAY_CACHE")
    os.environ["VOXRAY_CACHE"] = str(folder)
    try:
        yield
    finally:
        if before is None:
            del os.environ["VOXRAY_CACHE"]
        else:
            os.environ["VOXRAY_CACHE"] = before


def first_difference(packed: Any, here: Any, path: str) -> str:
    """Where two trees differ, "" where they don't."""
    if isinstance(packed, dict) and isinstance(here, dict):
        for key in dict.fromkeys([*packed, *here]):
            if found := first_difference(packed.get(key), here.get(key), f"{path}.{key}" if path else key):
                return found
        return ""
    return "" if packed == here else f"{path}: {json.dumps(packed)} was packed, {json.dumps(here)} ran"


def shown(value: Any) -> str:
    return "-" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)


class Verdicts:
    """Prints a line for each claim, and counts them."""

    def __init__(self, quiet: bool) -> None:
        self._quiet, self.counts = quiet, Counter()

    def add(self, verdict: str, text: str) -> None:
        self.counts[verdict] += 1
        if verdict == NOT or not self._quiet:
            print(f"{verdict:16}  {text}", flush=True)

    def claim(self, claim: claims.Claim, found: Any) -> None:
        interval = f" in [{shown(claim.low)}, {shown(claim.high)}]" if claim.low is not None else ""
        self.add(claim.verdict(found), f"{claim.of}: {claim.what}: {shown(claim.value)}{interval}, here {shown(found)}")

    def status(self, name: str) -> int:
        told = ", ".join(f"{self.counts[verdict]} {verdict}" for verdict in ("same", "within tolerance") if self.counts[verdict])
        wrong = self.counts[NOT]
        print(f"{name}: " + (f"{wrong} of {self.counts.total()} not confirmed" + (f"; {told}" if told else "") if wrong else
                             f"confirmed: {told}"), flush=True)
        return 1 if wrong else 0


def with_packed_scenes(program: Program, pack: study_pack.Pack, own: str | None) -> Program:
    """Scenes of the pack are found first, then those of the user's folder."""
    packed = pack.folder / "scenes"
    if not packed.is_dir():
        return program
    if own:
        os.environ["VOXRAY_SCENES"] = own
    return program.replace(scenes=str(packed))


def check_inputs(pack: study_pack.Pack, folders: list[str], verdicts: Verdicts) -> None:
    """Whether files of the pack and of its scenes are those that were packed."""
    for text in pack.damaged:
        verdicts.add(NOT, text)
    for scene in pack.record["scenes"]:
        wrong = packed_scenes.differences(scene, folders)
        verdicts.add(NOT if wrong else "same", f"scene {scene['name']}" + (f": {'; '.join(wrong)}" if wrong else ""))


def refuse_programs(pack: study_pack.Pack) -> None:
    """@throws UsageError for a pack with a pass that may run a program: what others give does not choose what runs here"""
    def has_external(value: Any) -> bool:
        if isinstance(value, dict):
            return any(map(has_external, value.values()))
        return any(map(has_external, value)) if isinstance(value, list) else value == "external"
    if has_external(json.loads(pack.config.read_text(encoding="utf-8"))):
        raise UsageError(f"{pack.record['name']}: the pack has the pass 'external', which may run a program of its author's: not run")


def check_results(pack: study_pack.Pack, results: Path, verdicts: Verdicts) -> None:
    manifest = json.loads((results / "manifest.json").read_text(encoding="utf-8"))
    packed = json.loads((pack.results / "manifest.json").read_text(encoding="utf-8"))
    difference = first_difference(config_of(packed), manifest["config"], "")
    verdicts.add(NOT if difference else "same", f"config{': ' + difference if difference else ''}")
    found: dict[tuple[str, str], Any] = {}
    for entry in manifest.get("references") or []:
        if (folder := pack.results / "images" / entry["folder"]).is_dir():
            found |= claims.found_of_reference(folder, results / "images" / entry["folder"])
    scores = claims.found_scores(results)
    for record in pack.record["claims"]:
        claim = claims.Claim(**record)
        here = found.get((claim.of, claim.what)) if claim.what in (claims.MEAN, claims.IMAGE) else scores.get(claim.of, {}).get(claim.what)
        verdicts.claim(claim, here)


def tell_versions(pack: study_pack.Pack, results: Path) -> None:
    here = json.loads((results / "manifest.json").read_text(encoding="utf-8"))
    was = pack.record["versions"]
    print(f"packed: Voxray {was['voxray']} ({was['commit'][:12]}) on {pack.record['device']}, {was['system']}\n"
          f"here:   Voxray {here['versions']['voxray']} ({here['commit'][:12]}) on {here['device']}", flush=True)


def main(program: Program, options: SimpleNamespace) -> int:
    verdicts = Verdicts(bool(options.quiet))
    with tempfile.TemporaryDirectory(prefix="voxray-verify-") as scratch:
        pack = study_pack.unpack(Path(options.pack), Path(scratch) / "pack")
        refuse_programs(pack)
        program = with_packed_scenes(program, pack, options.scenes)
        name = pack.record["name"]
        check_inputs(pack, program.plan(str(pack.config))["scene_folders"], verdicts)
        if verdicts.counts[NOT]:
            return verdicts.status(name)

        results = Path(options.out) if options.out else Path(scratch) / "results"
        with own_references(Path(scratch) / "cache"):
            program.replace(quiet=True).run(str(pack.config), str(results), ["--no-report"])
        if not (results / "results.csv").exists():
            raise Failed(f"{results}: the run left no results")
        tell_versions(pack, results)
        check_results(pack, results, verdicts)
        return verdicts.status(name)
