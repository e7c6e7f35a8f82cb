"""What the header says of a run: scene, camera, lights, what moves, image, reference and device; which variants compare."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from report import text
from report.results import Results, entries, number, section

_SOURCES = ("file", "builtin")
_OWN_ENTRIES = ("camera", "lights", "environment", "add", "override", "keep_file_lights", "time_step")
# Kinds of lights: where they are, what their strength is and its unit, and what `move` is in
_LIGHTS = {"directional": ("towards", "irradiance", "W/m²", "of its direction"), "point": ("at", "intensity", "W/sr", "m"),
           "spot": ("at", "intensity", "W/sr", "m")}
_MOVING = {"move", "off_at", "time_step", "moving_spheres", "swing"}  # keys of a config
_MAX_FRAMES = 8  # that are listed


def setting_of(results: Results) -> list[tuple[str, str]]:
    """Facts by their names, those that the manifest has."""
    manifest = results.manifest
    scene, image, reference = (section(parent, key) for parent, key in (
        (section(manifest, "config"), "scene"), (manifest, "image"), (manifest, "reference")))
    moves = _motion(results)
    facts = [("scene", _scene(scene), ("scene",)), ("camera", _camera(scene.get("camera")), ("scene", "scene.camera")),
             ("lights", _lights(scene), ("scene", "scene.lights"))]
    said = {name: f"{words} (the sweep varies it)" if words and _is_swept(results, keys) else words for name, words, keys in facts}
    said |= {"in motion": moves, "scores": _compared(results, moves),
             "image": f"{image.get('width', '?')} × {image.get('height', '?')} pixels" if image else "",
             "reference": _joined(reference.get("pass"), *(f"{reference[key]} {words}" for key, words in (
                 ("spp", "samples a pixel"), ("bounces", "bounces")) if key in reference)),
             "device": _joined(manifest.get("device"), manifest.get("tracer") and f"rays by {manifest['tracer']}")}
    return [(name, words) for name, words in said.items() if words]


def scenes_of(results: Results) -> list[str]:
    """A short name of the scene that each variant shows: the sweep's, where it varies the scene, else the config's."""
    own = _scene(section(section(results.manifest, "config"), "scene")) or "scene"
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


def _is_swept(results: Results, keys: tuple[str, ...]) -> bool:
    return any(key in keys or key.startswith(f"{keys[-1]}.") for key in results.sweep_keys)


def _scene(scene: dict) -> str:
    source = next((scene[key] for key in _SOURCES if scene.get(key)), "")
    more = [f"{key.replace('_', ' ')} {text.plain(value)}" for key, value in scene.items()
            if key not in (*_SOURCES, *_OWN_ENTRIES) and value is not None]
    more += [f"with {text.plain(entry.get('file') or entry.get('builtin') or '?')}" for entry in entries(scene, "add")]
    return _joined(source, *more) if source else ""


def _camera(camera) -> str:
    if not isinstance(camera, dict):
        return str(camera or "")
    words = f"at {text.plain(camera.get('position'))} looking at {text.plain(camera.get('target'))}"
    return _joined(words, "fov_deg" in camera and f"{text.plain(camera['fov_deg'])}° high")


def _lights(scene: dict) -> str:
    lights = scene.get("lights") or []
    words = [_light(light) if isinstance(light, dict) else str(light) for light in (lights if isinstance(lights, list) else [lights])]
    return "; ".join(words + ([f"environment {text.plain(scene['environment'])}"] if "environment" in scene else []))


def _kind(light: dict) -> str:
    return next((kind for kind in _LIGHTS if kind in light), "")


def _light(light: dict) -> str:
    kind = _kind(light)
    if not kind:
        return text.plain(light)
    where, quantity, unit, _ = _LIGHTS[kind]
    strength = light.get(quantity)
    if isinstance(strength, list) and len(set(map(str, strength))) == 1:
        strength = strength[0]
    return _joined(f"{kind} {where} {text.plain(light[kind])}", strength is not None and f"{text.plain(strength)} {unit}")


def _motion(results: Results) -> str:
    """What moves and how far in a frame; "" where all stands still. Of scenes that the sweep names, each with its name."""
    config = section(results.manifest, "config")
    sweep = section(config, "sweep")
    named = section(sweep, "scene")
    told = [] if named else [_moving(section(config, "scene"))]
    told += [f"{name}: {moving}" for name in named if (moving := _moving(section(named, name)))]
    told += [f"as the sweep varies it ({key})" for key, values in sweep.items()
             if key.startswith("scene.") and _tells_motion(key, values)]
    return "; ".join(filter(None, told))


def _compared(results: Results, moves: str) -> str:
    """Which frames the scores are of; "" where nothing moves and frame 0 alone is compared."""
    frames = [str(int(frame)) for frame in sorted(set(results.frames["frame"])) if math.isfinite(frame)]
    if len(frames) > 1:
        listed = ", ".join(frames if len(frames) <= _MAX_FRAMES else [*frames[:2], "…", frames[-1]])
        return f"of frame 0 in the table, of frames {listed} under “Over frames”"
    return "of frame 0, where all is as the config places it" if moves else ""


def _moving(scene: dict) -> str:
    return ", ".join(_moving_parts(scene))


def _moving_parts(scene: dict) -> Iterator[str]:
    camera = section(scene, "camera")
    if _is_some(camera.get("move")):
        yield f"camera by {text.plain(camera['move'])} m a frame"
    for light in filter(_kind, entries(scene, "lights")):
        if _is_some(light.get("move")):
            yield f"{_kind(light)} light by {text.plain(light['move'])} {_LIGHTS[_kind(light)][-1]} a frame"
        if number(light.get("off_at")) > 0:
            yield f"{_kind(light)} light off from frame {text.plain(light['off_at'])} on"
    seconds, spheres = number(scene.get("time_step")), section(scene, "moving_spheres")
    if seconds > 0 and spheres and number(spheres.get("count", 1)) > 0:
        # Whole swings are as long as four times `swing`, at constant speed
        swing, period = spheres.get("swing"), number(spheres.get("period"))
        meters = 4 * math.hypot(*map(number, swing)) * seconds / period if isinstance(swing, list) and period > 0 else math.nan
        yield f"{text.plain(spheres.get('count', 1))} spheres" + (f" by {text.figures(meters)} m a frame" if math.isfinite(meters) else "")
    if seconds > 0:
        yield f"animation by {text.figures(seconds)} s a frame"


def _is_some(move) -> bool:
    return any(abs(number(value)) > 0 for value in (move if isinstance(move, list) else [move]))


def _tells_motion(key: str, values) -> bool:
    """Whether a key of the sweep, or a key in its values, is one that moves things."""
    inside = values.items() if isinstance(values, dict) else [("", value) for value in values] if isinstance(values, list) else []
    return not _MOVING.isdisjoint(key.split(".")) or any(_tells_motion(str(name), value) for name, value in inside)
