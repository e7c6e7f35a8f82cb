#!/usr/bin/python3
"""Compares images of `run` with those of a session and of the Python module, for all variants of many configs.

session_bits.py PROGRAM [CONFIG...] [--most N] [--done FILE] [--seconds N] [--whole]: renders the small profile of each config
(all of configs/) at 48x27 pixels, without a reference where the config allows it, by `voxray run`, and in one session that
selects the variants by turns. Voxels, light rays and the like are fewer (COSTLY), unless --whole is given, or the config refuses
that: what is kept on the device from variant to variant is the same. Images have to be the same bits, and a variant that fails
has to fail in both. Of a config with more than --most variants, so many are compared (chosen()), each run by a process of its
own (`run --part`). A variant that differs is run twice more: where these two differ as well, as with writes that depend on the
order of threads, it is told and left out. FILE keeps what was compared, a line each; a later call goes on. After N seconds no
other config is begun. Prints what differs; exit status 1 where something does.
"""
import argparse
import copy
import json
import re
import subprocess
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


def chosen(names, most):
    """@param names of variants by id, which are the names of their values
    @return ids of at most so many variants: the first one; those that have most values that no earlier one has; and, where all
        values are there, evenly spread ones. How many values they have, and how many there are."""
    values = {variant: set(name.split(", ")) for variant, name in names.items()}
    every = set().union(*values.values())
    ids = [*names][:1]
    seen = set(values[ids[0]])
    while len(ids) < min(most, len(names)) and seen != every:
        ids.append(max(values, key=lambda variant: len(values[variant] - seen)))
        seen |= values[ids[-1]]
    rest = [variant for variant in names if variant not in ids]
    more = min(most, len(names)) - len(ids)
    ids += [rest[(2 * i + 1) * len(rest) // (2 * more)] for i in range(more)]
    return [variant for variant in names if variant in ids], len(seen), len(every)


def said(program, *words):
    """What the program prints. @throws VoxrayError"""
    done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise voxray.VoxrayError(done.stderr.strip())
    return done.stdout


def parts(program, config, words):
    """The parts of an experiment (docs/parts.md). @throws VoxrayError where the config can't be run so"""
    said(program, "run", config, "--dry-run", "--quiet", *words)  # Checks all profiles
    return {job["id"]: job for job in json.loads(said(program, "jobs", config, "--json", *words))["jobs"]}


def least(program, configs, options):
    """@param configs files of the same config, the cheapest first
    @return the file and the words for the cheapest experiment that it allows, and its parts. @throws VoxrayError"""
    for config in configs:
        for less in LESS:
            words = [*voxray._words({**SMALL, **less}, None), *options]
            try:
                return config, words, parts(program, config, words)
            except voxray.VoxrayError as error:
                last = error
    raise last


def run_all(program, config, words, folder):
    """@return ids of the variants that failed"""
    variants = voxray.run(config, out=folder, options=["--no-report", *words], program=program).variants
    return set(variants["variant"][variants["status"] == "failed"])


def run_some(program, config, words, folder, known, variants):
    """Runs variants by a process each, and their references. @return ids of those that failed"""
    failed = set()

    def run(part):
        return subprocess.run([program, "run", config, "--part", part, "--out", folder, "--quiet", "--no-report", *words], capture_output=True,
                              text=True, check=False)

    for part in sorted({before for variant in variants for before in known[f"variant.{variant}"]["after"]}):
        if run(part).returncode != 0:
            raise voxray.VoxrayError(f"{part} failed")
    for variant in variants:
        done = run(f"variant.{variant}")
        if done.returncode == 1:
            failed.add(variant)
        elif done.returncode != 0:
            raise voxray.VoxrayError(done.stderr.strip())
    return failed


def has_profile(config, name):
    return re.search(rf"^  {name}:", config.read_text(encoding="utf-8"), re.MULTILINE) is not None


def bits(image):
    return None if image is None else np.asarray(image, np.float32).view(np.uint32)


def same(a, b):
    return (a is None) == (b is None) and (a is None or np.array_equal(bits(a), bits(b)))


def images(files):
    """@return images of a variant's folder, None for one that isn't there"""
    return {name: exr_pixels.rgb(files / f"{name}.exr") if (files / f"{name}.exr").exists() else None for name in ("final", "indirect")}


def difference(session, variant, files, has_failed):
    """@return what differs of a variant, None where nothing does"""
    try:
        session.select(variant)
        shown = session.render()
    except voxray.VoxrayError as error:
        return None if has_failed else f"the session fails: {error}"
    if has_failed:
        return "the run fails, the session does not"
    differing = [name for name, of_run in images(files).items() if not same(getattr(shown, name), of_run)]
    return f"{', '.join(differing)} differs" if differing else None


def runs_differ(program, config, words, known, variant):
    """Whether two runs of a variant give different images."""
    with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
        for folder in (one, other):
            if run_some(program, config, words, folder, known, [variant]):
                return False
        first, second = (images(Path(folder) / "images" / variant) for folder in (one, other))
        return any(not same(first[name], second[name]) for name in first)


def differences(program, config, most, is_whole):
    """@return what was compared, in words and by number of variants, a line for each variant that differs, and for those left out"""
    profile = ["--profile", "small"] if has_profile(config, "small") else []
    options = [*profile, "--scenes", str(config.resolve().parent)]  # As if the cheaper config were there
    with tempfile.TemporaryDirectory() as temporary:
        configs, folder = [config], Path(temporary) / "run"
        if not is_whole:
            configs.insert(0, Path(temporary) / config.name)
            configs[0].write_text(cheaper(config.read_text(encoding="utf-8")), encoding="utf-8")
        config, words, known = least(program, configs, options)
        with voxray.Session(config, words, program) as session:
            variants, seen, every = chosen(session.variants, most)
            if len(variants) == len(session.variants):
                compared, failed = f"{len(variants)} variants", run_all(program, config, words, folder)
            else:
                compared = f"{len(variants)} of {len(session.variants)} variants with {seen} of {every} values"
                failed = run_some(program, config, words, folder, known, variants)
            found = {variant: difference(session, variant, folder / "images" / variant, variant in failed) for variant in variants}
        found = {variant: line for variant, line in found.items() if line}
        left_out = [variant for variant in found if variant not in failed and runs_differ(program, config, words, known, variant)]
        return (compared, len(variants) - len(left_out), [f"{variant}: {line}" for variant, line in found.items() if variant not in left_out],
                [f"{variant}: left out, two runs differ" for variant in left_out])


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program")
    parser.add_argument("configs", nargs="*", type=Path)
    parser.add_argument("--most", type=int, default=sys.maxsize)
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
            compared, variants, lines, left_out = differences(options.program, config, options.most, options.whole)
        except voxray.VoxrayError as error:
            compared, variants, lines, left_out = "0 variants", 0, [f"can't be run: {error}"], []
        known[key] = {"config": key, "compared": compared, "variants": variants, "differ": lines, "left_out": left_out}
        print(f"{key}: {compared}, {len(lines)} differ", *lines, *left_out, sep="\n  ", flush=True)
        if options.done:
            with options.done.open("a", encoding="utf-8") as file:
                file.write(json.dumps(known[key]) + "\n")
    print(f"{len(known)} of {len(configs)} configs, {sum(one['variants'] for one in known.values())} variants, "
          f"{sum(len(one['differ']) for one in known.values())} differ, {sum(len(one.get('left_out', ())) for one in known.values())} left out")
    return 1 if any(one["differ"] for one in known.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
