"""What the header says of a run: scene, camera, lights, what moves, image, reference and device."""

from __future__ import annotations

from dataclasses import replace

from report import motion, text
from report.results import Results, section

_SOURCES = ("file", "builtin")
_OWN_ENTRIES = ("camera", "lights", "environment", "add", "override", "keep_file_lights", "time_step")
_LIGHTS = {"directional": ("towards", "irradiance", "W/m²"), "point": ("at", "intensity", "W/sr"),
           "spot": ("at", "intensity", "W/sr")}


def setting_of(results: Results) -> list[tuple[str, str]]:
    """Facts by their names, those that the manifest has."""
    scene = section(section(results.manifest, "config"), "scene")
    facts = [("scene", _scene(scene)), ("camera", _camera(scene.get("camera"))), ("lights", _lights(scene))]
    facts = [(key, f"{words} (the sweep varies it)" if _is_swept(results, key) else words)
             for key, words in facts if words]
    facts += [("in motion", motion.words(results)), ("scores", motion.compared(results)), ("image", _image(results.manifest)),
              ("reference", _reference(results)), ("device", _device(results.manifest))]
    return [fact for fact in facts if fact[1]]


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


def _is_swept(results: Results, fact: str) -> bool:
    keys = {"scene": ("scene",), "camera": ("scene", "scene.camera"), "lights": ("scene", "scene.lights")}[fact]
    return any(key in keys or key.startswith(f"{keys[-1]}.") for key in results.sweep_keys)


def _scene(scene: dict) -> str:
    source = next((str(scene[key]) for key in _SOURCES if scene.get(key)), "")
    if not source:
        return ""
    more = [f"{key.replace('_', ' ')} {text.plain(value)}" for key, value in scene.items()
            if key not in (*_SOURCES, *_OWN_ENTRIES) and value is not None]
    more += [f"with {text.plain(entry.get('file') or entry.get('builtin') or '?')}"
             for entry in scene.get("add") or [] if isinstance(entry, dict)]
    return ", ".join([source, *more])


def _camera(camera) -> str:
    if not isinstance(camera, dict):
        return str(camera) if camera else ""
    words = f"at {text.plain(camera.get('position'))} looking at {text.plain(camera.get('target'))}"
    return words + (f", {text.plain(camera['fov_deg'])}° high" if "fov_deg" in camera else "")


def _lights(scene: dict) -> str:
    lights, words = scene.get("lights"), []
    for light in lights if isinstance(lights, list) else [lights] if lights else []:
        words.append(_light(light) if isinstance(light, dict) else str(light))
    if "environment" in scene:
        words.append(f"environment {text.plain(scene['environment'])}")
    return "; ".join(words)


def _light(light: dict) -> str:
    kind = next((kind for kind in _LIGHTS if kind in light), "")
    if not kind:
        return text.plain(light)
    where, quantity, unit = _LIGHTS[kind]
    strength = light.get(quantity)
    if isinstance(strength, list) and len(set(map(str, strength))) == 1:
        strength = strength[0]
    words = f"{kind} {where} {text.plain(light[kind])}"
    return words if strength is None else f"{words}, {text.plain(strength)} {unit}"


def _image(manifest: dict) -> str:
    image = section(manifest, "image")
    return f"{image.get('width', '?')} × {image.get('height', '?')} pixels" if image else ""


def _reference(results: Results) -> str:
    reference = section(results.manifest, "reference")
    parts = [str(reference.get("pass", ""))]
    for key, words in (("spp", "samples a pixel"), ("bounces", "bounces")):
        if key in reference:
            parts.append(f"{reference[key]} {words}")
    return ", ".join(part for part in parts if part)


def _device(manifest: dict) -> str:
    tracer = manifest.get("tracer")
    return ", ".join(part for part in (str(manifest.get("device") or ""), f"rays by {tracer}" if tracer else "") if part)
