"""What changes from frame to frame in a run, and which of its frames the scores are of."""

from __future__ import annotations

import math
from collections.abc import Iterator

from report import text
from report.results import Results, number, section

_KEYS = ("move", "off_at", "time_step", "moving_spheres")  # of a config
_MOVE_UNITS = {"point": "m", "spot": "m", "directional": "of its direction"}  # kinds of lights -> what `move` is in
_MAX_FRAMES = 8  # that are listed


def words(results: Results) -> str:
    """What moves and how far in a frame; "" where all stands still. Of scenes that the sweep names, each with its name."""
    config = section(results.manifest, "config")
    sweep = section(config, "sweep")
    named = section(sweep, "scene")
    told = [] if named else [_moving(section(config, "scene"))]
    told += [f"{name}: {moving}" for name, scene in named.items() if isinstance(scene, dict) and (moving := _moving(scene))]
    told += [f"as the sweep varies it ({key})" for key, values in sweep.items()
             if key.startswith("scene.") and _tells_motion(key, values)]
    return "; ".join(filter(None, told))


def compared(results: Results) -> str:
    """Which frames the scores are of; "" where nothing moves and frame 0 alone is compared."""
    frames = [str(int(frame)) for frame in sorted(set(results.frames["frame"])) if math.isfinite(frame)]
    if len(frames) > 1:
        listed = ", ".join(frames if len(frames) <= _MAX_FRAMES else [*frames[:2], "…", frames[-1]])
        return f"of frame 0 in the table, of frames {listed} under “Over frames”"
    return "of frame 0, where all is as the config places it" if words(results) else ""


def _moving(scene: dict) -> str:
    return ", ".join(_parts(scene))


def _parts(scene: dict) -> Iterator[str]:
    camera = scene.get("camera")
    if isinstance(camera, dict) and _is_some(camera.get("move")):
        yield f"camera by {text.plain(camera['move'])} m a frame"
    lights = scene.get("lights")
    for light in lights if isinstance(lights, list) else []:
        kind = next((kind for kind in _MOVE_UNITS if isinstance(light, dict) and kind in light), "")
        if kind and _is_some(light.get("move")):
            yield f"{kind} light by {text.plain(light['move'])} {_MOVE_UNITS[kind]} a frame"
        if kind and number(light.get("off_at")) > 0:
            yield f"{kind} light off from frame {text.plain(light['off_at'])} on"
    seconds = number(scene.get("time_step"))
    if seconds > 0:
        yield from _spheres(section(scene, "moving_spheres"), seconds)
        yield f"animation by {text.figures(seconds)} s a frame"


def _spheres(spheres: dict, seconds: float) -> Iterator[str]:
    """Whole swings are as long as four times `swing`, at constant speed."""
    if spheres and number(spheres.get("count", 1)) > 0:
        swing, period = spheres.get("swing"), number(spheres.get("period"))
        meters = 4 * math.hypot(*map(number, swing)) * seconds / period if isinstance(swing, list) and period > 0 else math.nan
        by = f" by {text.figures(meters)} m a frame" if math.isfinite(meters) else ""
        yield f"{text.plain(spheres.get('count', 1))} spheres{by}"


def _is_some(move) -> bool:
    return any(abs(number(value)) > 0 for value in (move if isinstance(move, list) else [move]))


def _tells_motion(key: str, values) -> bool:
    """Whether a key of the sweep, or a key in its values, is one that moves things."""
    if any(word in _KEYS for word in key.split(".")):
        return True
    inside = values.items() if isinstance(values, dict) else (("", value) for value in values) if isinstance(values, list) else ()
    return any(_tells_motion(str(name), value) for name, value in inside)
