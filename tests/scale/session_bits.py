#!/usr/bin/python3
"""Compares images of `run` with those of a session and of the Python module, for all variants of many configs.

session_bits.py PROGRAM [CONFIG...] [--done FILE] [--seconds N] [--whole]: renders the small profile of each config (all of
configs/) at 48x27 pixels, without a reference where the config allows it, by `voxray run`, and in one session that selects the
variants by turns. Voxels, light rays and the like are fewer (COSTLY), unless --whole is given, or the config refuses that:
what is kept on the device from variant to variant is the same. Images have to be the same bits, and a variant that fails has to
fail in both. FILE keeps what was compared, a line each; a later call goes on. After N seconds no other config is begun. Prints
what differs; exit status 1 where something does.
"""
import argparse
import copy
import json
import re
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "framework" / "python"))
import numpy as np  # noqa: E402
import voxray  # noqa: E402
import yaml  # noqa: E402
from report import exr_pixels  # noqa: E402

SMALL = {"image.width": 48, "image.height": 27, "measure.second_seed": False, "measure.build_repeats": 0}
# Not every config goes without a reference (masks) or with one frame (motion), and some have frames or samples of their own
LESS = ({"reference": None, "measure.frames": 1}, {"reference": None}, {"reference.spp": 2, "measure.frames": 1}, {"reference.spp": 2}, {})

# By the last word of a path: what numbers are divided by, and the least that is left
COSTLY = {"rays_per_light": (32, 1024), "rays_per_image": (32, 1024), "resolution": (4, 8), "rsm_resolution": (4, 32),
          "shadow_resolution": (4, 32), "map_resolution": (4, 16), "map_points": (8, 256), "target": (8, 16), "vpls_per_bounce": (8, 16),
          "count": (8, 2), "spp": (8, 1), "rays_per_surfel": (4, 4), "paths_per_point": (4, 2), "rays": (4, 4)}


def cheaper(text):
    """@return the text of a config with fewer of what is COSTLY. Lists keep as many values as they have."""
    root = yaml.compose(text, Loader=yaml.BaseLoader)

    def divide(node, by, least):
        if isinstance(node, yaml.ScalarNode) and node.style is None and re.fullmatch(r"[0-9]+", node.value):
            node.value = str(min(int(node.value), max(int(node.value) // by, least)))
        elif isinstance(node, yaml.SequenceNode):
            values = [copy.deepcopy(value) for value in node.value]
            for value in values:
                divide(value, by, least)
            if len({yaml.serialize(value) for value in values}) == len({yaml.serialize(value) for value in node.value}):
                node.value = values
        elif isinstance(node, yaml.MappingNode):
            visit(node)

    def visit(node):
        if isinstance(node, yaml.MappingNode):
            for key, value in node.value:
                word = key.value.rpartition(".")[2]
                divide(value, *COSTLY[word]) if word in COSTLY else visit(value)
        elif isinstance(node, yaml.SequenceNode):
            for value in node.value:
                visit(value)

    visit(root)
    return yaml.serialize(root, Dumper=yaml.BaseDumper)


def rendered(program, configs, profile, folder, options):
    """@param configs files of the same config, the cheapest first
    @return the file that was run, what was changed, and the results of the run. @throws VoxrayError"""
    for config in configs:
        for less in LESS:
            try:
                changed = {**SMALL, **less}
                return config, changed, voxray.run(config, set=changed, profile=profile, out=folder, options=["--no-report", *options], program=program)
            except voxray.VoxrayError as error:
                last = error
    raise last


def has_profile(config, name):
    return re.search(rf"^  {name}:", config.read_text(encoding="utf-8"), re.MULTILINE) is not None


def bits(image):
    return None if image is None else np.asarray(image, np.float32).view(np.uint32)


def same(a, b):
    return (a is None) == (b is None) and (a is None or np.array_equal(bits(a), bits(b)))


def differences(program, config, is_whole):
    """@return number of variants, and a line for each that differs"""
    profile = "small" if has_profile(config, "small") else None
    beside = ["--scenes", str(config.resolve().parent)]  # As if the cheaper config were there
    with tempfile.TemporaryDirectory() as folder:
        configs = [config]
        if not is_whole:
            configs.insert(0, Path(folder) / config.name)
            configs[0].write_text(cheaper(config.read_text(encoding="utf-8")), encoding="utf-8")
        config, changed, results = rendered(program, configs, profile, Path(folder) / "run", beside)
        status = dict(zip(results.variants["variant"], results.variants["status"], strict=True))
        lines = []
        options = [*voxray._words(changed, profile), *beside]
        with voxray.Session(config, options, program) as session:
            for variant, name in session.variants.items():
                files = Path(folder) / "run" / "images" / variant
                try:
                    session.select(variant)
                    shown = session.render()
                except voxray.VoxrayError as error:
                    if status.get(name) != "failed":
                        lines.append(f"{variant}: the session fails: {error}")
                    continue
                if status.get(name) == "failed":
                    lines.append(f"{variant}: the run fails, the session does not")
                    continue
                indirect = files / "indirect.exr"
                for what, of_session, of_run in (("final", shown.final, exr_pixels.rgb(files / "final.exr")),
                                                 ("indirect", shown.indirect, exr_pixels.rgb(indirect) if indirect.exists() else None)):
                    if not same(of_session, of_run):
                        lines.append(f"{variant}: {what} differs")
            return len(session.variants), lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program")
    parser.add_argument("configs", nargs="*", type=Path)
    parser.add_argument("--done", type=Path)
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("--whole", action="store_true")
    options = parser.parse_args()
    end = time.monotonic() + options.seconds
    configs = options.configs or sorted((ROOT / "configs").rglob("*.yaml"))
    known = {}
    if options.done and options.done.exists():
        known = {entry["config"]: entry for entry in map(json.loads, options.done.read_text(encoding="utf-8").splitlines())}
    for config in configs:
        key = str(config.resolve().relative_to(ROOT)) if config.resolve().is_relative_to(ROOT) else str(config)
        if key in known:
            continue
        if time.monotonic() > end:
            break
        try:
            variants, lines = differences(options.program, config, options.whole)
        except voxray.VoxrayError as error:
            variants, lines = 0, [f"can't be run: {error}"]
        known[key] = {"config": key, "variants": variants, "differ": lines}
        print(f"{key}: {variants} variants, {len(lines)} differ", *lines, sep="\n  ", flush=True)
        if options.done:
            with options.done.open("a", encoding="utf-8") as file:
                file.write(json.dumps(known[key]) + "\n")
    print(f"{len(known)} of {len(configs)} configs, {sum(one['variants'] for one in known.values())} variants, "
          f"{sum(len(one['differ']) for one in known.values())} differ")
    return 1 if any(one["differ"] for one in known.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
