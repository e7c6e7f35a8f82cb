#!/usr/bin/python3
"""Changes a session at random and compares its images with those of fresh ones.

session_changes.py PROGRAM [CHANGES] [SEED] [EVERY]: right and wrong values of parameters by the JSON Schema, passes, cameras,
lights, sizes and seeds. After every few it renders; of EVERY renders (1) one has to fail where a fresh session fails, and else to
give its bits. The second half of the changes is the first half again: it compiles no program that wasn't there, of which Vulkan
keeps the machine code, so that memory must not grow. Prints what was refused and the memory of the process; exit status 1 where
something differs or memory grows.
"""
import itertools
import json
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[2] / "framework" / "python"))
import numpy as np  # noqa: E402
import voxray  # noqa: E402

CONFIG = {"name": "changes", "scene": {"builtin": "cornell"}, "image": {"width": 24, "height": 16}, "seed": 1,
          "measure": {"frames": 1, "warmup": 1},
          "graph": [{"pass": "gbuffer", "samples_per_pixel_edge": 1}, {"pass": "voxelize", "resolution": 12},
                    {"pass": "inject_light_rays", "id": "inject", "rays_per_light": 2048}, {"pass": "direct_shadow_rays"},
                    {"pass": "gather_irradiance", "id": "gather"}, {"pass": "composite"}]}
GATHERS = ("gather_irradiance", ["trace_gather_rays", "gather_rays"], ["trace_gather_rays", "gather_rays", "filter_irradiance"],
           ["filter_voxels", {"pass": "gather_cones", "cones": 5}],
           [{"pass": "place_surfels"}, "inject_surfels", {"pass": "gather_surfels"}], "nothing", {"pass": "path_trace", "spp": 2})
RENDER_EVERY = 4
GREW = 1.01  # largest ratio of resident memory in the second half of the renders to that of the first


def values(schema, chance):
    """Values of a parameter: its default, others that are right, and wrong ones."""
    if "enum" in schema:
        return [*schema["enum"], "neither"]
    low, high = schema.get("minimum", 0), schema.get("maximum", 1)
    if schema.get("type") == "integer":
        return [low, min(high, low + chance.randrange(6)), min(high, 2 + chance.randrange(30)), low - 1, "many"]
    if schema.get("type") == "number":
        return [low, low + (min(high, low + 4) - low) * chance.random(), low - 1, None]
    return [True, False, 3]


def changes(program, chance):
    """An endless stream of (path, value)."""
    schema = json.loads(subprocess.run([program, "schema"], stdout=subprocess.PIPE, check=True).stdout)
    kinds = {kind["properties"]["pass"]["const"]: kind["properties"] for kind in schema["properties"]["graph"]["items"]["oneOf"]}
    ids = {"gbuffer": "gbuffer", "voxelize": "voxelize", "inject": "inject_light_rays", "direct_shadow_rays": "direct_shadow_rays",
           "trace_gather_rays": "trace_gather_rays", "gather": None}
    while True:
        what = chance.random()
        if what < 0.2:
            yield "gather", chance.choice(GATHERS)
        elif what < 0.35:
            yield "scene.camera", {"position": [chance.uniform(-0.5, 0.5), 1, chance.uniform(1, 3.2)], "target": [0, 1, 0], "fov_deg": 60}
        elif what < 0.4:
            yield "scene.lights", [{"point": [chance.uniform(-0.5, 0.5), 1.5, 0], "intensity": [1, 1, 1]}]
        elif what < 0.45:
            yield "image.width", chance.choice([24, 16, 0, 33])
        elif what < 0.5:
            yield "seed", chance.randrange(4)
        else:
            id, kind = chance.choice(list(ids.items()))
            parameters = kinds[kind or chance.choice([kind for kind in kinds if kind.startswith("gather")])]
            name = chance.choice([name for name in parameters if name not in ("pass", "id", "inputs")] or ["size"])
            if name not in ("samples_per_pixel_edge", "visibility_rays"):
                yield f"{id}.{name}", chance.choice(values(parameters.get(name, {}), chance))


def resident(session):
    with open(f"/proc/{session.process_id}/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def attempt(session):
    """An image, or the words of the error."""
    try:
        return session.render().final
    except voxray.VoxrayError as error:
        return str(error).partition(": ")[2]


def run(program, count, seed, folder, every=1):
    """@param every compares one of so many renders @return what differs, a line each, and counts of changes taken, changes
    refused, renders; and memory by render, bytes"""
    differ, taken, renders, memory = [], 0, 0, []
    config = Path(folder) / "changes.json"
    config.write_text(json.dumps(CONFIG), encoding="utf-8")
    half = list(itertools.islice(changes(program, random.Random(seed)), count - count // 2))
    with voxray.Session(config, ["--validate"], program) as session:
        for number, (path, value) in enumerate((half * 2)[:count], 1):
            if number == len(half) + 1:
                session.select("default", keep=False)
            try:
                session.set(path, value)
                taken += 1
            except voxray.VoxrayError as error:
                if "Vulkan" in str(error) or "internal" in str(error):
                    differ.append(f"{path}={value}: {error}")
            if number % RENDER_EVERY:
                continue
            shown = attempt(session)
            renders += 1
            memory.append(resident(session))
            if isinstance(shown, str) and ("Vulkan" in shown or "internal" in shown):
                differ.append(f"after {number} changes: {shown}")
            if renders % every:
                continue
            config.write_text(json.dumps(session.config), encoding="utf-8")
            with voxray.Session(config, ["--validate"], program) as fresh:
                right = attempt(fresh)
            if type(shown) is not type(right) or not np.array_equal(shown, right):
                differ.append(f"after {number} changes, the last one {path}={value}: {right if isinstance(right, str) else 'another image'}"
                              f"{' in place of ' + shown if isinstance(shown, str) else ''}; {config.read_text(encoding='utf-8')}")
    return differ, (taken, count - taken, renders), memory


def main():
    program, count, seed, every = sys.argv[1], *(int(word) for word in (*sys.argv[2:], *("1000", "1", "1")[len(sys.argv) - 2:]))
    with tempfile.TemporaryDirectory() as folder:
        differ, (taken, refused, renders), memory = run(program, count, seed, folder, every)
    print(*differ, sep="\n", end="\n" if differ else "")
    half = len(memory) // 2
    print(f"{taken} changes taken, {refused} refused, {renders} renders; resident memory {max(memory[:half]) / 2**20:.1f} MiB in the "
          f"first half, {max(memory[half:]) / 2**20:.1f} in the second")
    return 1 if differ or max(memory[half:]) > GREW * max(memory[:half]) else 0


if __name__ == "__main__":
    sys.exit(main())
