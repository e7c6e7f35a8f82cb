"""Renders a scene that Voxray exported with Blender's Cycles: the program of configs/external/cycles.yaml.

    blender -b --factory-startup --python-exit-code 1 --python scripts/external/cycles.py -- [--srgb-filter] SIDECAR

It writes final.exr, or direct.exr and indirect.exr, and time.json next to the side-car (docs/external.md). All surfaces
reflect and occlude on both sides, BLEND is opaque, lights are points and suns without size; there is no clamping, no
denoising, no adaptive sampling and no filter wider than a pixel. Textures of colour are decoded before they are
filtered, as glTF asks for; with --srgb-filter Cycles filters their bytes and decodes the result, as it does by itself.
The time is that of the samples: the scene has been loaded by a rendering of one sample before.
"""

import json
import math
import os
import struct
import sys
import time

import numpy

LIGHT_PASSES = ("Diff", "Gloss", "Trans")  # Cycles' names of kinds of reflection in its passes


def to_blender(v):
    """A vector of glTF, +Y up, as Blender has it, +Z up."""
    return v[0], -v[2], v[1]


def materials_of(scene_path):
    """The materials of a .glb file, as its JSON has them."""
    with open(scene_path, "rb") as file:
        length = struct.unpack("<I", file.read(20)[12:16])[0]
        return json.loads(file.read(length)).get("materials", [])


# Materials

def hand_over(tree, source, target):
    """Gives a socket what another one has: its link or its value."""
    if source.is_linked:
        tree.links.new(source.links[0].from_socket, target)
    else:
        target.default_value = source.default_value


def lambert(tree, principled):
    """An exact Lambert surface in place of the principled one."""
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    hand_over(tree, principled.inputs["Base Color"], diffuse.inputs["Color"])
    if principled.inputs["Normal"].is_linked:
        hand_over(tree, principled.inputs["Normal"], diffuse.inputs["Normal"])
    return diffuse.outputs[0]


def with_emission(tree, principled, surface, is_double_sided):
    """Adds the emission to a surface, on its front alone unless it is double-sided."""
    emission, strength = principled.inputs["Emission"], principled.inputs["Emission Strength"].default_value
    if strength == 0 or not (emission.is_linked or max(emission.default_value[:3]) > 0):
        return surface
    lamp = tree.nodes.new("ShaderNodeEmission")
    hand_over(tree, emission, lamp.inputs["Color"])
    lamp.inputs["Strength"].default_value = strength
    if not is_double_sided:
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
    return both.outputs[0]


def masked(tree, principled, surface, cutoff):
    """Cuts out what has less alpha than the cutoff."""
    is_cut = tree.nodes.new("ShaderNodeMath")
    is_cut.operation = "LESS_THAN"
    hand_over(tree, principled.inputs["Alpha"], is_cut.inputs[0])
    is_cut.inputs[1].default_value = cutoff
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(is_cut.outputs[0], mix.inputs["Fac"])
    tree.links.new(surface, mix.inputs[1])
    tree.links.new(tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[2])
    return mix.outputs[0]


def as_gltf(material, described, is_lambert):
    """Replaces what the importer made of a glTF material by what Voxray renders of it."""
    tree = material.node_tree
    principled = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    surface = lambert(tree, principled) if is_lambert else principled.outputs[0]
    surface = with_emission(tree, principled, surface, described.get("doubleSided", False))
    if described.get("alphaMode") == "MASK":
        surface = masked(tree, principled, surface, described.get("alphaCutoff", 0.5))
    tree.links.new(surface, output.inputs["Surface"])
    if is_lambert:
        tree.nodes.remove(principled)
        return
    for name in ("Emission", "Alpha"):
        for link in principled.inputs[name].links:
            tree.links.remove(link)
    principled.inputs["Emission Strength"].default_value = 0
    principled.inputs["Alpha"].default_value = 1
    specular = described.get("extensions", {}).get("KHR_materials_specular", {}).get("specularFactor", 1)
    principled.inputs["Specular"].default_value = 0.5 * specular  # 0.5: an index of refraction of 1.5


def decoded(bpy, image):
    """A float image with the linear colours of an sRGB one."""
    pixels = numpy.empty(len(image.pixels), numpy.float32)
    image.pixels.foreach_get(pixels)
    color = pixels.reshape(-1, 4)[:, :3]
    color[:] = numpy.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)
    linear = bpy.data.images.new(image.name + " decoded", *image.size, alpha=True, float_buffer=True, is_data=True)
    linear.alpha_mode = "CHANNEL_PACKED"
    linear.pixels.foreach_set(pixels)
    return linear


def decode_textures(bpy):
    known = {}
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else ():
            if node.type == "TEX_IMAGE" and node.image and node.image.colorspace_settings.name == "sRGB":
                if node.image not in known:
                    known[node.image] = decoded(bpy, node.image)
                node.image = known[node.image]


# Lights, environment, camera

def place(bpy, name, data, position, direction, up=None):
    """An object whose -Z axis is `direction`, in glTF's coordinates."""
    from mathutils import Matrix, Vector

    back = -Vector(to_blender(direction)).normalized()
    above = Vector(to_blender(up)) if up else Vector((0, 0, 1) if abs(back.z) < 0.9 else (1, 0, 0))
    right = above.cross(back).normalized()
    placed = bpy.data.objects.new(name, data)
    placed.matrix_world = Matrix.Translation(to_blender(position)) @ Matrix(
        (right, back.cross(right), back)).transposed().to_4x4()
    bpy.context.scene.collection.objects.link(placed)
    return placed


def shine_as_spot(lamp, light):
    """KHR_lights_punctual's fall-off, by the cosine between axis and ray, on a lamp that shines everywhere."""
    lamp.use_nodes = True
    tree = lamp.node_tree
    emission = next(n for n in tree.nodes if n.type == "EMISSION")

    def math_node(operation, first, second, clamps=False):
        node = tree.nodes.new("ShaderNodeMath")
        node.operation, node.use_clamp = operation, clamps
        tree.links.new(first, node.inputs[0])
        if isinstance(second, float):
            node.inputs[1].default_value = second
        else:
            tree.links.new(second, node.inputs[1])
        return node.outputs[0]

    cosine = tree.nodes.new("ShaderNodeVectorMath")
    cosine.operation = "DOT_PRODUCT"
    tree.links.new(tree.nodes.new("ShaderNodeNewGeometry").outputs["Incoming"], cosine.inputs[0])
    length = math.sqrt(sum(x * x for x in light["direction"]))
    cosine.inputs[1].default_value = [x / length for x in to_blender(light["direction"])]
    inner, outer = (math.cos(math.radians(light[key])) for key in ("inner_deg", "outer_deg"))
    above = math_node("SUBTRACT", cosine.outputs["Value"], outer)
    part = math_node("DIVIDE", above, max(0.001, inner - outer), clamps=True)
    tree.links.new(math_node("MULTIPLY", part, part), emission.inputs["Strength"])


def add_light(bpy, light):
    is_sun = light["type"] == "directional"
    strength = light["irradiance" if is_sun else "intensity"]
    largest = max(strength)
    if largest == 0:
        return
    lamp = bpy.data.lights.new(light["name"], "SUN" if is_sun else "POINT")
    lamp.color = [channel / largest for channel in strength]
    if is_sun:
        lamp.energy, lamp.angle = largest, 0
    else:
        lamp.energy, lamp.shadow_soft_size = 4 * math.pi * largest, 0
    if light["type"] == "spot":
        shine_as_spot(lamp, light)
    place(bpy, light["name"], lamp, light.get("position", (0, 0, 0)), light.get("direction", (0, -1, 0)))


def set_environment(bpy, scene, environment, folder):
    """None: black. A map's center is seen along -Z of glTF, and its right half is at +X."""
    scene.world = bpy.data.worlds.new("environment")
    scene.world.color = (0, 0, 0)
    if not environment:
        return
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    background = next(n for n in tree.nodes if n.type == "BACKGROUND")
    background.inputs["Color"].default_value = (*environment["radiance"], 1)
    if "map" not in environment:
        return
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(os.path.join(folder, environment["map"]))
    picture.image.colorspace_settings.name = "Linear"
    turn = tree.nodes.new("ShaderNodeMapping")
    turn.inputs["Rotation"].default_value[2] = -math.pi / 2  # Blender's own center is at +X
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], turn.inputs["Vector"])
    tree.links.new(turn.outputs["Vector"], picture.inputs["Vector"])
    scaled = tree.nodes.new("ShaderNodeMixRGB")
    scaled.blend_type = "MULTIPLY"
    scaled.inputs["Fac"].default_value = 1
    tree.links.new(picture.outputs["Color"], scaled.inputs[1])
    scaled.inputs[2].default_value = (*environment["radiance"], 1)
    tree.links.new(scaled.outputs[0], background.inputs["Color"])


def set_camera(bpy, scene, view):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle_y = math.radians(view["vertical_fov_deg"])
    camera.clip_start, camera.clip_end = 1e-3, 1e4
    scene.camera = place(bpy, "camera", camera, view["position"], view["forward"], view["up"])


# The whole

def set_cycles(scene, sidecar):
    """Rendering as Voxray's path tracer does."""
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = sidecar["image"]["width"], sidecar["image"]["height"]
    render.resolution_percentage = 100
    render.use_persistent_data = True
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    cycles.device = "CPU"
    cycles.sampling_pattern = "SOBOL"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = sidecar["bounces"]
    cycles.transparent_max_bounces = 1024


def load(bpy, sidecar, folder, filters_srgb=False):
    """The scene of a side-car in an otherwise empty file, ready to render. @param folder of the side-car's files"""
    numpy.bool = bool  # Debian 12's glTF importer still uses this name, its numpy no longer has it.
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene_path = os.path.join(folder, sidecar["scene"])
    bpy.ops.import_scene.gltf(filepath=scene_path)
    for thing in [o for o in bpy.data.objects if o.type in ("LIGHT", "CAMERA")]:
        bpy.data.objects.remove(thing)
    described = {m.get("name"): m for m in materials_of(scene_path)}
    for material in bpy.data.materials:
        if material.node_tree and any(n.type == "BSDF_PRINCIPLED" for n in material.node_tree.nodes):
            as_gltf(material, described.get(material.name, {}), sidecar["materials"] == "lambert")
    if not filters_srgb:
        decode_textures(bpy)
    for mesh in (o for o in bpy.data.objects if o.type == "MESH"):
        mesh.cycles.shadow_terminator_offset = mesh.cycles.shadow_terminator_geometry_offset = 0
    scene = bpy.context.scene
    for light in sidecar["lights"]:
        add_light(bpy, light)
    set_environment(bpy, scene, sidecar["environment"], folder)
    set_camera(bpy, scene, sidecar["camera"])
    set_cycles(scene, sidecar)
    return scene


def write_parts(bpy, scene, folder):
    """Lets the compositor write direct and indirect light. Light of reflections is that of a pass times its colour."""
    layer = bpy.context.view_layer
    for kind in ("diffuse", "glossy", "transmission"):
        for what in ("indirect", "color"):
            setattr(layer, f"use_pass_{kind}_{what}", True)
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    layers = tree.nodes.new("CompositorNodeRLayers")

    def mixed(kind, first, second):
        node = tree.nodes.new("CompositorNodeMixRGB")
        node.blend_type = kind
        tree.links.new(first, node.inputs[1])
        tree.links.new(second, node.inputs[2])
        return node.outputs[0]

    indirect = None
    for kind in LIGHT_PASSES:
        part = mixed("MULTIPLY", layers.outputs[kind + "Ind"], layers.outputs[kind + "Col"])
        indirect = mixed("ADD", indirect, part) if indirect else part
    writer = tree.nodes.new("CompositorNodeOutputFile")
    writer.base_path = folder
    writer.format.file_format, writer.format.color_depth = "OPEN_EXR", "32"
    writer.file_slots.clear()
    for name, socket in (("indirect", indirect), ("direct", mixed("SUBTRACT", layers.outputs["Image"], indirect))):
        writer.file_slots.new(name)
        tree.links.new(socket, writer.inputs[name])


def render(bpy, scene, samples, seed, path):
    """Renders into a file. @return wall seconds"""
    scene.cycles.samples = samples
    scene.cycles.seed = seed % (1 << 31)
    scene.render.filepath = path
    start = time.time()
    bpy.ops.render.render(write_still=True)
    return time.time() - start


def main(sidecar_path, filters_srgb):
    import bpy

    with open(sidecar_path, encoding="utf-8") as file:
        sidecar = json.load(file)
    if sidecar["format"] != 1:
        sys.exit(f"{sidecar_path}: format {sidecar['format']} is not 1, which this script reads")
    folder = os.path.dirname(os.path.abspath(sidecar_path))
    scene = load(bpy, sidecar, folder, filters_srgb)
    has_parts = sidecar["light"] == "parts"
    if has_parts:
        write_parts(bpy, scene, folder)
    final = os.path.join(folder, "final.exr")
    render(bpy, scene, 1, sidecar["seed"], final)
    seconds = render(bpy, scene, sidecar["spp"], sidecar["seed"], final)
    for name in ("direct", "indirect") if has_parts else ():
        os.replace(os.path.join(folder, f"{name}{scene.frame_current:04d}.exr"), os.path.join(folder, f"{name}.exr"))
    with open(os.path.join(folder, "time.json"), "w", encoding="utf-8") as file:
        json.dump({"render_seconds": seconds}, file)


if __name__ == "__main__":
    words = sys.argv[sys.argv.index("--") + 1:]
    main(words[-1], "--srgb-filter" in words[:-1])
