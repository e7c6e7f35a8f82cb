"""Measures Blender's Cycles on a scene that Voxray exported, and compares it with Voxray's path tracer.

    VOXRAY_EXPORT=cornell.glb bench_trace --benchmark_filter=pathTraceCornell/64 \\
        --benchmark_out=ours.json --benchmark_out_format=json
    /usr/bin/python3 tests/bench/cycles_compare.py cornell.glb ours.json

Both render 512x512 on all CPU cores with a 1-pixel box filter, no denoising, no adaptive sampling and no clamping.
Speed is the slope between two numbers of samples, so that starting up does not count. Variance is the spread
between seeds times the samples a pixel. The last lines give samples a second at equal variance, by wall clock and
by CPU time; the latter holds on a busy machine too.
"""

import json
import os
import subprocess
import sys
import tempfile
import time

SIZE = 512
FEW, MANY = 4, 32
SEEDS = 4
BOUNCES = 64


def make_lambert(bpy, material):
    """Replaces what the glTF importer made by an exact Lambert surface that emits on its front."""
    tree = material.node_tree
    principled = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
    colour = list(principled.inputs["Base Color"].default_value)
    emission = list(principled.inputs["Emission"].default_value)
    strength = principled.inputs["Emission Strength"].default_value
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = colour
    if strength * max(emission[:3]) == 0:
        tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
        return
    lamp = tree.nodes.new("ShaderNodeEmission")
    lamp.inputs["Color"].default_value = emission
    front = tree.nodes.new("ShaderNodeMath")
    front.operation = "MULTIPLY_ADD"
    front.inputs[1].default_value = -strength
    front.inputs[2].default_value = strength
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    both = tree.nodes.new("ShaderNodeAddShader")
    tree.links.new(geometry.outputs["Backfacing"], front.inputs[0])
    tree.links.new(front.outputs[0], lamp.inputs["Strength"])
    tree.links.new(diffuse.outputs[0], both.inputs[0])
    tree.links.new(lamp.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], output.inputs["Surface"])


def set_up(bpy, scene_path):
    """Loads the scene into an empty file and sets Cycles to what Voxray renders."""
    import numpy

    numpy.bool = bool  # Debian 12's glTF importer still uses this name, its numpy no longer has it.
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=scene_path)
    for material in bpy.data.materials:
        if material.node_tree and any(n.type == "BSDF_PRINCIPLED" for n in material.node_tree.nodes):
            make_lambert(bpy, material)
    scene = bpy.context.scene
    scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")
    scene.camera.data.clip_start, scene.camera.data.clip_end = 1e-3, 1e4
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x = render.resolution_y = SIZE
    render.resolution_percentage = 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = BOUNCES
    return scene


def render_once(bpy, scene, folder, samples, seed):
    """Returns wall seconds, CPU seconds and the pixels."""
    import numpy

    scene.cycles.samples = samples
    scene.cycles.seed = seed
    scene.render.filepath = os.path.join(folder, f"{samples}_{seed}.exr")
    cpu = sum(os.times()[:2])
    wall = time.time()
    bpy.ops.render.render(write_still=True)
    wall, cpu = time.time() - wall, sum(os.times()[:2]) - cpu
    image = bpy.data.images.load(scene.render.filepath)
    image.colorspace_settings.name = "Linear"
    pixels = numpy.empty(SIZE * SIZE * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return wall, cpu, pixels.reshape(-1, 4)[:, :3].astype(numpy.float64)


def measure_in_blender(scene_path, out_path):
    import bpy
    import numpy

    scene = set_up(bpy, scene_path)
    with tempfile.TemporaryDirectory() as folder:
        few = [render_once(bpy, scene, folder, FEW, seed) for seed in range(SEEDS)]
        many = [render_once(bpy, scene, folder, MANY, seed) for seed in range(SEEDS)]
    drawn = SIZE * SIZE * (MANY - FEW)
    slope = [min(m[i] for m in many) - min(f[i] for f in few) for i in (0, 1)]
    pixels = numpy.stack([m[2] for m in many])
    result = {
        "samples_per_s": drawn / slope[0],
        "samples_per_cpu_s": drawn / slope[1],
        "sample_variance": float(pixels.var(axis=0, ddof=1).mean() * MANY),
        "mean": float(pixels.mean()),
    }
    with open(out_path, "w", encoding="utf-8") as out:
        json.dump(result, out)


def main():
    scene_path, ours_path = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        out_path = os.path.join(folder, "cycles.json")
        subprocess.run(
            ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__, "--",
             scene_path, out_path],
            check=True, stdout=subprocess.DEVNULL)
        with open(out_path, encoding="utf-8") as file:
            cycles = json.load(file)
    with open(ours_path, encoding="utf-8") as file:
        runs = json.load(file)["benchmarks"]
    ours = next(r for r in runs if r["name"].startswith(f"pathTraceCornell/{BOUNCES}"))
    for key in ("mean", "sample_variance", "samples_per_s", "samples_per_cpu_s"):
        print(f"{key:18} Voxray {ours[key]:12.6g}   Cycles {cycles[key]:12.6g}   ratio {ours[key] / cycles[key]:.3f}")
    for clock in ("samples_per_s", "samples_per_cpu_s"):
        ratio = ours[clock] / ours["sample_variance"] * cycles["sample_variance"] / cycles[clock]
        print(f"{clock} at equal variance: {ratio:.2f} times Cycles")


if __name__ == "__main__":
    if "--" in sys.argv:
        measure_in_blender(*sys.argv[sys.argv.index("--") + 1:][:2])
    else:
        main()
