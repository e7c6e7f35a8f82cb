#!/usr/bin/python3
"""Compares images of `run` with those of a session and of the Python module, for all variants of many configs.

session_bits.py PROGRAM [CONFIG...] [--done FILE] [--seconds N]: renders the small profile of each config (all of configs/)
at 48x27 pixels, without a reference where the config allows it, by `voxray run`, and in one session that selects the variants
by turns. Images have to be the same bits, and a variant that fails has to fail in both. FILE keeps what was compared, a line
each; a later call goes on. After N seconds no other config is begun. Prints what differs; exit status 1 where something does.
"""
import argparse
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
from report import exr_pixels  # noqa: E402

SMALL = {"image.width": 48, "image.height": 27, "measure.second_seed": False, "measure.build_repeats": 0}
# Not every config goes without a reference (masks) or with one frame (motion), and some have frames or samples of their own
LESS = ({"reference": None, "measure.frames": 1}, {"reference": None}, {"reference.spp": 2, "measure.frames": 1}, {"reference.spp": 2}, {})


def rendered(program, config, profile, folder):
    """@return what was changed, and the results of the run. @throws VoxrayError"""
    for less in LESS:
        try:
            changed = {**SMALL, **less}
            return changed, voxray.run(config, set=changed, profile=profile, out=folder, options=["--no-report"], program=program)
        except voxray.VoxrayError as error:
            last = error
    raise last


def has_profile(config, name):
    return re.search(rf"^  {name}:", config.read_text(encoding="utf-8"), re.MULTILINE) is not None


def bits(image):
    return None if image is None else np.asarray(image, np.float32).view(np.uint32)


def same(a, b):
    return (a is None) == (b is None) and (a is None or np.array_equal(bits(a), bits(b)))


def differences(program, config):
    """@return number of variants, and a line for each that differs"""
    profile = "small" if has_profile(config, "small") else None
    with tempfile.TemporaryDirectory() as folder:
        changed, results = rendered(program, config, profile, Path(folder) / "run")
        status = dict(zip(results.variants["variant"], results.variants["status"], strict=True))
        lines = []
        options = [*voxray._words(changed, profile)]
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
            variants, lines = differences(options.program, config)
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
