#!/usr/bin/python3
"""Compares imported scenes with the images of their own renderers.

check_imports.py [NAME...] [--scenes DIR] [--spp N] [--out DIR] [--program PROGRAM] [--all]

Renders each scene of the list below by path_trace, as it was imported, at the size of its reference image and with its number of
bounces, and prints a row for each: the ratio of the means of luminance, of red, green and blue, the root mean square of the
differences over the mean, and the warnings of the import. NAME: a scene of the list; all where none is named. DIR of --scenes: the
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
from report import exr_pixels, images  # noqa: E402
from report.rows import markdown_table  # noqa: E402

MITSUBA_TESTS = "mitsuba-3/mitsuba-data/tests/scenes"
TOLERANCE = 0.01


class Scene:
    """A scene and the image of its own renderer.

    bounces: after direct light, as in the reference. part: rows and columns (from, to) of the image that are diffuse, as shares
    of its size; None: the whole image. is_diffuse: whether the mean has to agree.
    """

    def __init__(self, path, reference, bounces=0, part=None, is_diffuse=True):
        self.path, self.reference, self.bounces, self.part, self.is_diffuse = path, reference, bounces, part, is_diffuse


def spheres(light, part=None, is_diffuse=True):
    folder = f"{MITSUBA_TESTS}/bsdf_spheres"
    return Scene(f"{folder}/test_{light}_path.xml", f"{folder}/refs/test_{light}_ref_rgb.exr", 0, part, is_diffuse)


def mitsuba_test(folder, name, reference, bounces=0, part=None, is_diffuse=True):
    return Scene(f"{MITSUBA_TESTS}/{folder}/{name}.xml", f"{MITSUBA_TESTS}/{folder}/refs/{reference}_ref_rgb.exr", bounces, part,
                 is_diffuse)


# Two Lambert spheres and two leaves, at the lower right
DIFFUSE_SPHERES = ((0.44, 1.0), (0.6, 1.0))

SCENES = {
    "instancing": mitsuba_test("instancing", "test_instancing_path", "test_instancing"),
    "shapes": mitsuba_test("various_shapes", "test_various_shapes_path", "test_various_shapes"),
    "textures": mitsuba_test("texture_interp", "test_texture_interp_direct", "test_texture_interp"),
    "vertex colors": mitsuba_test("mesh_attributes", "test_mesh_attributes_3_vertex_direct", "test_mesh_attributes_3_vertex"),
    "directional": mitsuba_test("floating_sphere", "test_directional_direct", "test_directional"),
    "emitters": mitsuba_test("various_emitters", "test_various_emitters_ptracer", "test_various_emitters", 2),
    "textured sphere": spheres("textured_diffuse"),
    "area light": spheres("arealight", DIFFUSE_SPHERES),
    "constant": spheres("constant", DIFFUSE_SPHERES),
    "environment": spheres("envmap", DIFFUSE_SPHERES),
    "point light": spheres("pointlight", DIFFUSE_SPHERES),
    "rough conductor": spheres("textured_roughconductor", is_diffuse=False),
    "principled": spheres("texturedprincipled1", is_diffuse=False),
}


def render(scene, options, folder, size):
    """The image by path_trace, and the warnings of the import."""
    config = {
        "name": "check",
        "scene": {"file": str(options.scenes / scene.path)},
        "image": {"width": size[1], "height": size[0]},
        "graph": [{"pass": "path_trace", "spp": options.spp, "bounces": scene.bounces}],
        "measure": {"frames": 1, "warmup": 0, "build_repeats": 0},
    }
    path = folder / "check.yaml"
    path.write_text(json.dumps(config), encoding="utf-8")
    out = folder / "out"
    done = subprocess.run([options.program, "run", path, "--out", out, "--no-report", "--quiet"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stdout.strip())
    manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
    return exr_pixels.rgb(out / "images" / "default" / "final.exr"), manifest.get("warnings", [])


def compared(image, scene, options):
    if scene.part is None or options.all:
        return image
    (top, bottom), (left, right) = (tuple(round(share * length) for share in of) for of, length in zip(scene.part, image.shape))
    return image[top:bottom, left:right]


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
        theirs = compared(exr_pixels.rgb(options.scenes / scene.reference), scene, options)
        size = exr_pixels.rgb(options.scenes / scene.reference).shape[:2]
        with tempfile.TemporaryDirectory() as temporary:
            folder = options.out / name.replace(" ", "_") if options.out else Path(temporary)
            folder.mkdir(parents=True, exist_ok=True)
            try:
                image, warnings = render(scene, options, folder, size)
            except RuntimeError as error:
                rows.append([name, *["-"] * 5])
                notes.append(f"{name}: {error}")
                is_off = is_off or scene.is_diffuse
                continue
        ours = compared(image, scene, options)
        ratio = (ours @ images.LUMINANCE).mean() / (theirs @ images.LUMINANCE).mean()
        channels = ours.reshape(-1, 3).mean(axis=0) / theirs.reshape(-1, 3).mean(axis=0)
        spread = np.sqrt(np.mean(((ours - theirs) @ images.LUMINANCE) ** 2)) / (theirs @ images.LUMINANCE).mean()
        rows.append([name, f"{ratio:.4f}", *(f"{channel:.3f}" for channel in channels), f"{spread:.3f}"])
        notes += [f"{name}: {warning}" for warning in warnings]
        is_off = is_off or (scene.is_diffuse and not abs(ratio - 1) <= TOLERANCE)
    print("\n".join(markdown_table(["scene", "mean ratio", "red", "green", "blue", "RMS"], rows)))
    print("\n".join(["", *notes]))
    return int(is_off)


if __name__ == "__main__":
    os.environ.setdefault("VOXRAY_SKIP_SETUP", "1")
    sys.exit(main())
