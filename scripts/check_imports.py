#!/usr/bin/python3
"""Compares imported scenes with the images of their own renderers.

check_imports.py [NAME...] [--scenes DIR] [--spp N] [--out DIR] [--program PROGRAM] [--all]

Renders each scene of the list below by path_trace, as it was imported, at the size of its reference image and with its number of
bounces, and prints a row for each: what `voxray compare` says of the ratio of the means and of nRMSE, and below the table the
warnings of the import. NAME: a scene of the list; all where none is named. DIR of --scenes: the
folder of the test scenes' formats, in which files that are missing are said to be. Where a scene has materials that are
approximated, the list names the part of its image that has none; --all compares whole images. --out keeps the images.
Exit status 1: a mean is off by more than 1 % where all that is compared is diffuse.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.append(str(ROOT / "framework"))
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402
from report import exr_pixels  # noqa: E402
from report.rows import markdown_table  # noqa: E402

MITSUBA_TESTS = "mitsuba-3/mitsuba-data/tests/scenes"
TOLERANCE = 0.01


class Scene:
    """A scene and the image of its own renderer.

    bounces: after direct light, as in the reference. size: of the image. part: x, y, width and height of the pixels that are
    diffuse; None: the whole image. is_diffuse: whether the mean has to agree. is_filmic: the reference is a PNG with Tungsten's
    filmic curve, of which the pixels count that are neither black nor white.
    """

    def __init__(self, path, reference, size=(48, 48), bounces=0, part=None, is_diffuse=True, is_filmic=False):
        self.path, self.reference, self.size, self.bounces = path, reference, size, bounces
        self.part, self.is_diffuse, self.is_filmic = part, is_diffuse, is_filmic


def mitsuba_test(folder, name, reference, **more):
    return Scene(f"{MITSUBA_TESTS}/{folder}/{name}.xml", f"{MITSUBA_TESTS}/{folder}/refs/{reference}_ref_rgb.exr", **more)


def spheres(light, **more):
    return mitsuba_test("bsdf_spheres", f"test_{light}_path", f"test_{light}", **more)


def tungsten(folder, image="TungstenRender.png", **more):
    return Scene(f"pbrt-v4/{folder}/scene-v4.pbrt", f"pbrt-v4/{folder}/{image}", **more)


# Two Lambert spheres and two leaves, at the lower right of the grid of spheres
DIFFUSE_SPHERES = (29, 21, 19, 27)

SCENES = {
    "instancing": mitsuba_test("instancing", "test_instancing_path", "test_instancing", size=(64, 64)),
    # Without the open side of the cylinder, black in Mitsuba, and the torus by distances, which is left out
    "shapes": mitsuba_test("various_shapes", "test_various_shapes_path", "test_various_shapes", size=(480, 480),
                           part=(0, 0, 225, 480)),
    "textures": mitsuba_test("texture_interp", "test_texture_interp_direct", "test_texture_interp", size=(128, 128)),
    "vertex colors": mitsuba_test("mesh_attributes", "test_mesh_attributes_3_vertex_direct", "test_mesh_attributes_3_vertex"),
    "directional": mitsuba_test("floating_sphere", "test_directional_direct", "test_directional"),
    # Its projector is left out and its spots fall off otherwise
    "emitters": mitsuba_test("various_emitters", "test_various_emitters_ptracer", "test_various_emitters", size=(512, 64),
                             bounces=2, is_diffuse=False),
    "textured sphere": spheres("textured_diffuse"),
    "area light": spheres("arealight", part=DIFFUSE_SPHERES),
    "constant": spheres("constant", part=DIFFUSE_SPHERES),
    "environment": spheres("envmap", part=DIFFUSE_SPHERES),
    "point light": spheres("pointlight", part=DIFFUSE_SPHERES),
    "rough conductor": spheres("textured_roughconductor", is_diffuse=False),
    "principled": spheres("texturedprincipled1", is_diffuse=False),
    "pbrt cornell box": tungsten("cornell-box", "TungstenRender.exr", size=(1024, 1024), bounces=62),
    # Wall and floor left of the plates, lit by three spheres
    "pbrt spheres": tungsten("veach-mis", size=(640, 360), part=(0, 0, 130, 360), is_filmic=True),
    # An egg of glass, and lamps of metal
    "pbrt lamps": tungsten("veach-bidir", size=(512, 512), bounces=4, is_diffuse=False, is_filmic=True),
}


def voxray(options, *arguments):
    """What a command prints. @raises RuntimeError: it failed."""
    done = subprocess.run([options.program, *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stderr.strip())
    return done.stdout


def filmic(radiance):
    """Hejl and Burgess-Dawson's curve, which Tungsten's images have: display values of 0 to 1."""
    c = np.maximum(radiance - 0.004, 0)
    return c * (6.2 * c + 0.5) / (c * (6.2 * c + 1.7) + 0.06)


def filmic_scores(ours, reference, part):
    """Ratio of the means and nRMSE over blocks of 8 x 8 pixels between black and white, without the curve."""
    # Tungsten cuts what is behind the point of 255 v
    display = (np.asarray(Image.open(reference), dtype=float) + 0.5) / 255
    radiance = np.linspace(0, 10, 1000001)
    theirs = np.interp(display, filmic(radiance), radiance)
    x, y, width, height = part or (0, 0, ours.shape[1], ours.shape[0])
    def blocks(image):
        image = image[y:y + height, x:x + width]
        rows, columns = height // 8, width // 8
        return image[:rows * 8, :columns * 8].reshape(rows, 8, columns, 8, 3).mean(axis=(1, 3))
    shown = blocks(display).mean(axis=2)
    counts = (shown > 0.1) & (shown < 0.9)
    a, b = blocks(ours)[counts], blocks(theirs)[counts]
    return {"mean_ratio": a.mean() / b.mean(), "nrmse": np.sqrt(((a - b) ** 2).mean()) / b.mean()}


def check(scene, options, folder):
    """Scores of the scene's image by path_trace, and the warnings of its import."""
    config = {
        "name": "check",
        "scene": {"file": str(options.scenes / scene.path)},
        "image": {"width": scene.size[0], "height": scene.size[1]},
        "graph": [{"pass": "path_trace", "spp": options.spp, "bounces": scene.bounces}],
        "measure": {"frames": 1, "warmup": 0, "build_repeats": 0},
    }
    path = folder / "check.yaml"
    path.write_text(json.dumps(config), encoding="utf-8")
    out = folder / "out"
    voxray(options, "run", path, "--out", out, "--no-report", "--quiet")
    if scene.is_filmic:
        scores = filmic_scores(exr_pixels.rgb(out / "images" / "default" / "final.exr"), options.scenes / scene.reference,
                               None if options.all else scene.part)
        manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
        return scores, manifest.get("warnings", [])
    part = ["--part", ",".join(map(str, scene.part))] if scene.part and not options.all else []
    scores = voxray(options, "compare", out / "images" / "default" / "final.exr", options.scenes / scene.reference, "--json", *part)
    manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
    return json.loads(scores)["scores"], manifest.get("warnings", [])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--scenes", type=Path, default=ROOT / ".." / "shared" / "scenes" / "formats", metavar="DIR")
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--out", type=Path, metavar="DIR")
    parser.add_argument("--program", default=str(ROOT / "voxray"))
    parser.add_argument("--all", action="store_true")
    options = parser.parse_args()
    for name in options.names:
        if name not in SCENES:
            parser.error(f"no scene '{name}'; there are {', '.join(SCENES)}")

    rows, notes, is_off = [], [], False
    for name in options.names or SCENES:
        scene = SCENES[name]
        with tempfile.TemporaryDirectory() as temporary:
            folder = options.out / name.replace(" ", "_") if options.out else Path(temporary)
            folder.mkdir(parents=True, exist_ok=True)
            try:
                scores, warnings = check(scene, options, folder)
            except RuntimeError as error:
                scores, warnings = {}, [str(error)]
        ratio = scores.get("mean_ratio", float("nan"))
        what = "diffuse" if scene.is_diffuse and scene.part is None else "diffuse part" if scene.is_diffuse else "approximated"
        rows.append([name, what, f"{ratio:.4f}", f"{scores.get('nrmse', float('nan')):.3f}"])
        notes += [f"{name}: {warning}" for warning in warnings]
        is_off = is_off or (scene.is_diffuse and not options.all and not abs(ratio - 1) <= TOLERANCE)
    print("\n".join(markdown_table(["scene", "compared", "mean ratio", "nRMSE"], rows)))
    print("\n".join(["", *notes]))
    return int(is_off)


if __name__ == "__main__":
    os.environ.setdefault("VOXRAY_SKIP_SETUP", "1")
    sys.exit(main())
