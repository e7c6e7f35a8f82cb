"""What the header says of a run: its scene as the config has it, image, reference and device; which variants compare."""

from __future__ import annotations

import math
from dataclasses import replace

from report import text
from report.results import Results, section

_SOURCES = ("file", "builtin")
_MAX_FRAMES = 8  # that are listed


def setting_of(results: Results) -> list[tuple[str, str]]:
    """Facts by their names, those that the manifest has."""
    manifest = results.manifest
    scene, image, reference = (section(parent, key) for parent, key in (
        (section(manifest, "config"), "scene"), (manifest, "image"), (manifest, "reference")))
    facts = {"scene": _source(scene)}
    facts |= {key.replace("_", " "): text.plain(value) for key, value in scene.items() if key not in _SOURCES}
    facts |= {"the sweep varies": ", ".join(key for key in results.sweep_keys if key.split(".")[0] == "scene"),
              "scores": _compared(results),
              "image": f"{image.get('width', '?')} × {image.get('height', '?')} pixels" if image else "",
              "reference": _joined(reference.get("pass"), *(f"{reference[key]} {words}" for key, words in (
                  ("spp", "samples a pixel"), ("bounces", "bounces")) if key in reference)),
              "times": _clocks(results),
              "device": _joined(manifest.get("device"), manifest.get("tracer") and f"rays by {manifest['tracer']}")}
    return [(name, words) for name, words in facts.items() if words]


def scenes_of(results: Results) -> list[str]:
    """A short name of the scene that each variant shows: the sweep's, where it varies the scene, else the config's."""
    own = _source(section(section(results.manifest, "config"), "scene")) or "scene"
    swept = results.variants[[key for key in results.sweep_keys if key.split(".")[0] == "scene"]].astype(str)
    return [", ".join(value for value in row if value != "-") or own for row in swept.to_numpy()]


def comparisons(results: Results) -> list[tuple[str, Results]]:
    """The variants of one scene and one reference at a time, for errors and times of others don't compare, each with a name
    that no other has, in the order of the table. Other tables than `variants` are left whole."""
    keys = [(scene, results.reference_folder(variant) or "")
            for scene, variant in zip(scenes_of(results), results.variants["variant"])]
    different = list(dict.fromkeys(keys))
    scenes = [scene for scene, _ in different]
    return [(scene if scenes.count(scene) == 1 else f"{scene} ({folder})",
             replace(results, variants=results.variants[[key == (scene, folder) for key in keys]]))
            for scene, folder in different]


def _joined(*words) -> str:
    return ", ".join(str(word) for word in words if word)


def _clocks(results: Results) -> str:
    """Which variants' times the device did not measure, by their numbers, and who did."""
    told: dict[str, list[str]] = {}
    if "clock" in results.passes:  # runs of older versions have none
        for variant, clock in zip(results.passes["variant"], results.passes["clock"]):
            if clock:
                told.setdefault(clock, []).append(f"#{results.numbers[variant]}")
    return "; ".join(f"of {', '.join(dict.fromkeys(numbers))}: {clock}" for clock, numbers in told.items())


def _source(scene: dict) -> str:
    return str(next((scene[key] for key in _SOURCES if scene.get(key)), ""))


def _compared(results: Results) -> str:
    """Which frames the scores are of; "" where frame 0 alone is compared."""
    frames = [str(int(frame)) for frame in sorted(set(results.frames["frame"])) if math.isfinite(frame)]
    listed = ", ".join(frames if len(frames) <= _MAX_FRAMES else [*frames[:2], "…", frames[-1]])
    return f"of frame 0 in the table, of frames {listed} under “Over frames”" if len(frames) > 1 else ""
