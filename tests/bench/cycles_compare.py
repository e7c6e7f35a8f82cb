"""Measures Blender's Cycles on scenes that Voxray exported, and compares it with Voxray's path tracer.

    ninja -C build/release bench_trace && mkdir rivals
    VOXRAY_EXPORT=rivals build/release/tests/bench/bench_trace --benchmark_filter=pathTraceRival \\
        --benchmark_out=rivals/ours.json --benchmark_out_format=json
    /usr/bin/python3 tests/bench/cycles_compare.py rivals [SCENE...] [--nearest]

Both render the same pixels and bounces on all CPU cores with a 1-pixel box filter, no denoising, no adaptive sampling
and no clamping. All surfaces are Lambert, with the textures of colour, alpha masks and normals that the scene has.
Lights are points and suns without size: W/sr and W/m² in the file, W and W/m² in Blender. Speed is the slope between
two numbers of samples, so that starting up does not count. Variance is the spread between seeds times the samples a
pixel. The last lines of a scene give samples a second at equal variance, by wall clock and by CPU time; the latter
holds on a busy machine too. Cycles filters texels as sRGB stores them and converts afterwards, which darkens: with
--nearest it takes the nearest texel, whose mean is right. Images whose means differ by more than TOLERANCE are of two
scenes: no ratio, and exit status 1.
"""

import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import time

FEW = 4
SEEDS = 4
TOLERANCE = 0.03


def make_lambert(material):
    """Replaces what the glTF importer made by an exact Lambert surface that emits on its front."""
    tree = material.node_tree
    principled = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")

    def hand_over(name, target):
        source = principled.inputs[name]
        if source.is_linked:
            tree.links.new(source.links[0].from_socket, target)
        else:
            target.default_value = source.default_value

    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    hand_over("Base Color", diffuse.inputs["Color"])
    if principled.inputs["Normal"].is_linked:
        hand_over("Normal", diffuse.inputs["Normal"])
    surface = diffuse.outputs[0]

    emission, strength = principled.inputs["Emission"], principled.inputs["Emission Strength"].default_value
    if strength > 0 and (emission.is_linked or max(emission.default_value[:3]) > 0):
        lamp = tree.nodes.new("ShaderNodeEmission")
        hand_over("Emission", lamp.inputs["Color"])
        lamp.inputs["Strength"].default_value = strength
        if material.use_backface_culling:
            front = tree.nodes.new("ShaderNodeMath")
            front.operation = "MULTIPLY_ADD"
            front.inputs[1].default_value = -strength
            front.inputs[2].default_value = strength
            geometry = tree.nodes.new("ShaderNodeNewGeometry")
            tree.links.new(geometry.outputs["Backfacing"], front.inputs[0])
            tree.links.new(front.outputs[0], lamp.inputs["Strength"])
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(surface, both.inputs[0])
        tree.links.new(lamp.outputs[0], both.inputs[1])
        surface = both.outputs[0]

    if material.blend_method == "CLIP":
        is_cut = tree.nodes.new("ShaderNodeMath")
        is_cut.operation = "LESS_THAN"
        hand_over("Alpha", is_cut.inputs[0])
        is_cut.inputs[1].default_value = material.alpha_threshold
        masked = tree.nodes.new("ShaderNodeMixShader")
        tree.links.new(is_cut.outputs[0], masked.inputs["Fac"])
        tree.links.new(surface, masked.inputs[1])
        tree.links.new(tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0], masked.inputs[2])
        surface = masked.outputs[0]
    tree.links.new(surface, output.inputs["Surface"])
    tree.nodes.remove(principled)


def lights_of(scene_path):
    """The lights of a .glb file, as glTF describes them."""
    with open(scene_path, "rb") as file:
        length = struct.unpack("<I", file.read(20)[12:16])[0]
        scene = json.loads(file.read(length))
    return scene.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])


def set_lights(bpy, scene_path):
    """Gives the lights the file's power, whatever the importer makes of its units, and no size."""
    for light in lights_of(scene_path):
        lamp = bpy.data.lights[light["name"]]
        if light["type"] == "directional":
            lamp.energy, lamp.angle = light["intensity"], 0
        elif light["type"] == "point":
            lamp.energy, lamp.shadow_soft_size = 4 * math.pi * light["intensity"], 0
        else:
            sys.exit(f"{light['name']}: the edge of a {light['type']} light differs in Blender")


def take_nearest_texels(bpy):
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else ():
            if node.type == "TEX_IMAGE":
                node.interpolation = "Closest"


def set_up(bpy, scene_path, setup):
    """Loads the scene into an empty file and sets Cycles to what Voxray renders."""
    import numpy

    numpy.bool = bool  # Debian 12's glTF importer still uses this name, its numpy no longer has it.
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=scene_path)
    for material in bpy.data.materials:
        if material.node_tree and any(n.type == "BSDF_PRINCIPLED" for n in material.node_tree.nodes):
            make_lambert(material)
    if setup["nearest"]:
        take_nearest_texels(bpy)
    set_lights(bpy, scene_path)
    scene = bpy.context.scene
    for mesh in (o for o in bpy.data.objects if o.type == "MESH"):
        mesh.cycles.shadow_terminator_offset = mesh.cycles.shadow_terminator_geometry_offset = 0
    scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")
    scene.camera.data.clip_start, scene.camera.data.clip_end = 1e-3, 1e4
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = setup["width"], setup["height"]
    render.resolution_percentage = 100
    render.use_persistent_data = True
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = setup["bounces"]
    cycles.transparent_max_bounces = 1024
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
    pixels = numpy.empty(image.size[0] * image.size[1] * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return wall, cpu, pixels.reshape(-1, 4)[:, :3].astype(numpy.float64)


def measure_in_blender(scene_path, setup, out_path):
    import bpy
    import numpy

    scene = set_up(bpy, scene_path, setup)
    with tempfile.TemporaryDirectory() as folder:
        render_once(bpy, scene, folder, 1, SEEDS)  # Loads the scene, which later renderings keep.
        few = [render_once(bpy, scene, folder, FEW, seed) for seed in range(SEEDS)]
        many = [render_once(bpy, scene, folder, setup["spp"], seed) for seed in range(SEEDS)]
    drawn = setup["width"] * setup["height"] * (setup["spp"] - FEW)
    slope = [min(m[i] for m in many) - min(f[i] for f in few) for i in (0, 1)]
    pixels = numpy.stack([m[2] for m in many])
    result = {
        "samples_per_s": drawn / slope[0],
        "samples_per_cpu_s": drawn / slope[1],
        "sample_variance": float(pixels.var(axis=0, ddof=1).mean() * setup["spp"]),
        "mean": float(pixels.mean()),
    }
    with open(out_path, "w", encoding="utf-8") as out:
        json.dump(result, out)


def measure_cycles(scene_path, setup):
    """What measure_in_blender() tells, from a process of Blender."""
    with tempfile.TemporaryDirectory() as folder:
        out_path, log_path = os.path.join(folder, "cycles.json"), os.path.join(folder, "log")
        with open(log_path, "w", encoding="utf-8") as log:
            done = subprocess.run(
                ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__, "--",
                 scene_path, json.dumps(setup), out_path],
                stdout=log, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            with open(log_path, encoding="utf-8", errors="replace") as log:
                sys.exit("Blender failed:\n" + log.read()[-2000:])
        with open(out_path, encoding="utf-8") as file:
            return json.load(file)


def compare(ours, cycles):
    """Prints a scene's numbers. Returns whether both rendered the same image, to the tolerance."""
    for key in ("mean", "sample_variance", "samples_per_s", "samples_per_cpu_s"):
        print(f"{key:18} Voxray {ours[key]:12.6g}   Cycles {cycles[key]:12.6g}   ratio {ours[key] / cycles[key]:.3f}")
    difference = ours["mean"] / cycles["mean"] - 1
    if abs(difference) > TOLERANCE:
        print(f"the means differ by {100 * difference:.1f} %: not the same image, so speeds can't be compared")
        return False
    for clock in ("samples_per_s", "samples_per_cpu_s"):
        ratio = ours[clock] / ours["sample_variance"] * cycles["sample_variance"] / cycles[clock]
        print(f"{clock} at equal variance: {ratio:.2f} times Cycles")
    return True


def main():
    nearest = "--nearest" in sys.argv
    folder, *wanted = (word for word in sys.argv[1:] if word != "--nearest")
    with open(os.path.join(folder, "ours.json"), encoding="utf-8") as file:
        runs = [r for r in json.load(file)["benchmarks"] if r["name"].startswith("pathTraceRival/")]
    failed = [r["name"] for r in runs if r.get("error_occurred")]
    if failed or not runs:
        sys.exit(f"{folder}/ours.json: " + (f"{', '.join(failed)} failed" if failed else "no run of pathTraceRival"))
    missing = set(wanted) - {r["label"] for r in runs}
    if missing:
        sys.exit(f"{folder}/ours.json has no {', '.join(sorted(missing))}")
    agree = True
    for ours in runs:
        if wanted and ours["label"] not in wanted:
            continue
        setup = {key: int(ours[key]) for key in ("width", "height", "bounces", "spp")} | {"nearest": nearest}
        print(f"{ours['label']}, {setup['width']}x{setup['height']}, {setup['bounces']} bounces, {setup['spp']} spp")
        cycles = measure_cycles(os.path.join(folder, ours["label"] + ".glb"), setup)
        agree = compare(ours, cycles) and agree
    sys.exit(0 if agree else 1)


if __name__ == "__main__":
    if "--" in sys.argv:
        scene_path, setup, out_path = sys.argv[sys.argv.index("--") + 1:][:3]
        measure_in_blender(scene_path, json.loads(setup), out_path)
    else:
        main()
