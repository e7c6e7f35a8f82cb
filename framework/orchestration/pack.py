"""`voxray pack`: runs a config and writes all that others need to check its results into one file."""

from __future__ import annotations

import json
import platform
from pathlib import Path
from types import SimpleNamespace

from orchestration import claims, packed_scenes, study_pack
from orchestration.errors import Failed, UsageError
from orchestration.program import Program

BRIGHTNESS = 0.01  # a change that a pack should tell from noise
_TABLES = ("manifest.json", "results.csv", "passes.csv", "values.csv", "frames.csv")


def stated_licences(words: list[str]) -> dict[str, str]:
    """@param words SCENE=TEXT"""
    found = dict(word.partition("=")[::2] for word in words)
    for name, text in found.items():
        if not text:
            raise UsageError(f"--licence {name}: expected SCENE=TEXT, as in --licence 'room.glb=CC BY 4.0, Jane Doe'")
    return found


def system() -> str:
    """The system's name and version, as it calls itself."""
    return platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())


def config_of(manifest: dict) -> dict:
    """What was run, without options: a tracer that one chose is the config's."""
    tracer = manifest["requested"]["tracer"]
    return manifest["config"] | ({} if tracer == "auto" else {"tracer": tracer})


def files_of(results: Path, manifest: dict, config: Path) -> dict[str, Path | str]:
    found: dict[str, Path | str] = {"config.json": json.dumps(config_of(manifest), indent=1, ensure_ascii=False) + "\n",
                                    f"original/{config.name}": config}
    found |= {f"results/{name}": results / name for name in _TABLES if (results / name).exists()}
    for entry in manifest.get("references") or []:
        below = f"images/{entry['folder']}"
        names = [f"{light}_{half}.exr" for light in claims.LIGHT_OF_FILE for half in "ab"]
        found |= {f"results/{below}/{name}": results / below / name for name in names}
    return found


def warn(text: str) -> None:
    print(f"voxray: warning: {text}", flush=True)


def main(program: Program, options: SimpleNamespace) -> int:
    plan = program.plan(options.config)
    if plan["reference"] is None:
        raise UsageError(f"{plan['place']}: there is no 'reference', so no score that others could check: write one, as in "
                         "{pass: path_trace, spp: 1024, bounces: 8}")
    for variant in plan["variants"]:
        if any(isinstance(entry, dict) and entry.get("pass") == "external" for entry in variant["config"]["graph"]):
            raise UsageError(f"{plan['place']}: others have not the program or images of the pass 'external': leave these variants out, with --only")
    licences = stated_licences(options.licence)
    scenes, packed = packed_scenes.describe(packed_scenes.scene_names(plan["variants"]), plan["scene_folders"], licences,
                                            bool(options.with_scenes))
    results = Path(options.results or f"results/{plan['name']}")
    if status := program.run(options.config, str(results), ["--no-report"]):
        raise Failed(f"not packed, because not all variants ran; {results / 'results.csv'} says why")

    manifest = json.loads((results / "manifest.json").read_text(encoding="utf-8"))
    stated = [claim for entry in manifest["references"] for claim in claims.reference_claims(results / "images" / entry["folder"])]
    stated += claims.variant_claims(results, manifest)
    record = {"name": plan["name"], "versions": manifest["versions"] | {"commit": manifest["commit"], "system": system()},
              "device": manifest["device"], "machine": manifest["machine"], "scenes": scenes,
              "claims": [claim.record() for claim in stated]}
    target = Path(options.out or f"{plan['name']}.zip")
    study_pack.write(target, record, files_of(results, manifest, Path(options.config)) | packed)

    for scene in scenes:
        if not scene["licence"]:
            warn(f"{scene['name']}: its file states no licence; --licence '{scene['name']}=TEXT' does")
    resolved = claims.coarsest(stated)
    if resolved > BRIGHTNESS:
        warn(f"the reference's noise hides changes of brightness below {100 * resolved:.2g} %: raise reference.spp, or the image's size")
    left_out = [scene["name"] for scene in scenes if not scene["packed"]]
    print(f"{target}: {len(stated)} claims on {len(plan['variants'])} variants, {target.stat().st_size / 1024:.0f} KiB; "
          f"a change of brightness of {100 * resolved:.2g} % shows"
          + (f"; without {', '.join(left_out)}, of which it has hashes" if left_out else ""))
    return status
