#!/usr/bin/env python3
"""Writes a few hundred small glTF files after the families of Khronos' sample and generated assets.

usage: gltf_cases.py FOLDER

FOLDER/cases.json says of each file whether it is to be read or refused. Each good file has a floor of 4 x 4 m and an
object over it, so that there is something to render, whatever becomes of the object.
"""
import base64
import io
import itertools
import json
import math
import pathlib
import struct
import sys

import numpy
from PIL import Image

TYPES = {"b": (5120, numpy.int8), "B": (5121, numpy.uint8), "h": (5122, numpy.int16), "H": (5123, numpy.uint16),
         "I": (5125, numpy.uint32), "f": (5126, numpy.float32)}
SHAPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}

# A tetrahedron half a metre over the floor
POINTS = [(-0.5, 0.5, -0.5), (0.5, 0.5, -0.5), (0, 0.5, 0.5), (0, 1.25, 0)]
FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
CORNERS = [POINTS[i] for face in FACES for i in face]
FLOOR = [(-2, 0, -2), (-2, 0, 2), (2, 0, 2), (2, 0, -2)]


class Gltf:
    """A file in the making: JSON in `root`, data in one buffer, files next to it."""

    def __init__(self):
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}
        self.data = b""
        self.files = {}
        self.mesh(self.primitive(FLOOR, indices=self.accessor([0, 1, 2, 0, 2, 3], "B", 1)), name="floor")

    def add(self, key, value):
        self.root.setdefault(key, []).append(value)
        return len(self.root[key]) - 1

    def view(self, data, stride=None):
        self.data += b"\0" * (-len(self.data) % 4)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)}
        if stride:
            view["byteStride"] = stride
        self.data += data
        return self.add("bufferViews", view)

    def accessor(self, values, kind="f", width=3, stride=None, offset=0, **more):
        """Elements of `width` numbers, `stride` bytes apart, `offset` bytes into their view."""
        code, dtype = TYPES[kind]
        rows = numpy.array(values, dtype).reshape(-1, width)
        size = rows.itemsize * width
        step = stride or size
        data = bytearray(offset + step * len(rows))
        for i, row in enumerate(rows):
            data[offset + i * step:offset + i * step + size] = row.tobytes()
        accessor = {"bufferView": self.view(bytes(data), stride), "byteOffset": offset, "componentType": code,
                    "count": len(rows), "type": SHAPES[width], **more}
        if width == 3 and kind == "f":
            accessor["min"], accessor["max"] = rows.min(0).tolist(), rows.max(0).tolist()
        return self.add("accessors", accessor)

    def primitive(self, points, **more):
        attributes = {"POSITION": points if isinstance(points, int) else self.accessor(points)}
        return {"attributes": {**attributes, **more.pop("attributes", {})}, **more}

    def mesh(self, *primitives, name="object", node=None, **more):
        """A mesh and its node at the root of the scene. @return the node's number"""
        mesh = self.add("meshes", {"name": name, "primitives": list(primitives), **more})
        number = self.add("nodes", {"name": name, "mesh": mesh, **(node or {})})
        self.root["scenes"][0]["nodes"].append(number)
        return number

    def tetrahedron(self, node=None, **more):
        return self.mesh(self.primitive(CORNERS, **more), node=node)

    def image(self, kind="PNG"):
        pixels = numpy.zeros((4, 4, 3), numpy.uint8)
        pixels[::2, ::2] = pixels[1::2, 1::2] = (230, 120, 40)
        out = io.BytesIO()
        Image.fromarray(pixels).save(out, kind)
        return out.getvalue()

    def textured(self, image, sampler=None, **texture):
        coordinates = self.accessor([(0, 0), (2, 0), (0, 2)] * 4, "f", 2)
        self.add("images", image)
        self.add("textures", {"source": 0, **({"sampler": self.add("samplers", sampler)} if sampler else {}), **texture})
        material = self.add("materials", {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})
        self.tetrahedron(attributes={"TEXCOORD_0": coordinates}, material=material)

    def material(self, **material):
        self.tetrahedron(material=self.add("materials", material))

    def use(self, extension, required=False):
        for key in ["extensionsUsed"] + ["extensionsRequired"] * required:
            self.root.setdefault(key, []).append(extension)

    def animate(self, node, path, times, values, interpolation="LINEAR", width=3):
        samplers = [{"input": self.accessor(times, "f", 1), "output": self.accessor(values, "f", width),
                     "interpolation": interpolation}]
        self.add("animations", {"samplers": samplers,
                                "channels": [{"sampler": 0, "target": {"node": node, "path": path}}]})

    def write(self, path, container="glb"):
        root, data = json.loads(json.dumps(self.root)), self.data + b"\0" * (-len(self.data) % 4)
        buffers = root.setdefault("buffers", [{}])
        buffers[0].setdefault("byteLength", len(data))
        for name, content in self.files.items():
            (path.parent / name).parent.mkdir(parents=True, exist_ok=True)
            (path.parent / name).write_bytes(content)
        if container == "glb":
            text = json.dumps(root).encode()
            text += b" " * (-len(text) % 4)
            chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
            path.with_suffix(".glb").write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
            return path.with_suffix(".glb")
        if container == "data":
            buffers[0].setdefault("uri", "data:application/octet-stream;base64," + base64.b64encode(data).decode())
        else:
            buffers[0].setdefault("uri", path.name + ".bin")
            path.with_suffix(".bin").write_bytes(data)
        path.with_suffix(".gltf").write_text(json.dumps(root, ensure_ascii=False), encoding="utf-8")
        return path.with_suffix(".gltf")


def rotated(axis, degrees):
    half = math.radians(degrees) / 2
    return [*(math.sin(half) * numpy.array(axis, float)), math.cos(half)]


def meshes():
    """Buffers and primitives: layouts, types, modes, indices, sparse values."""
    for mode in range(7):
        g = Gltf()
        points = {5: [POINTS[i] for i in (0, 1, 3, 2, 0)], 6: [POINTS[3], *POINTS[:3], POINTS[0]]}.get(mode, CORNERS)
        g.mesh(g.primitive(points, mode=mode))
        yield f"mode_{mode}", g
        g = Gltf()
        order = {5: [0, 1, 3, 2, 0], 6: [3, 0, 1, 2, 0]}.get(mode, [i for face in FACES for i in face])
        g.mesh(g.primitive(POINTS, mode=mode, indices=g.accessor(order, "H", 1)))
        yield f"mode_{mode}_indexed", g
    for kind in "BHI":
        g = Gltf()
        g.mesh(g.primitive(POINTS, indices=g.accessor(FACES, kind, 1)))
        yield f"indices_{kind}", g
    for stride, offset in itertools.product([12, 16, 20, 252], [0, 4, 8]):
        g = Gltf()
        g.mesh(g.primitive(g.accessor(CORNERS, stride=stride, offset=offset)))
        yield f"stride_{stride}_offset_{offset}", g
    for kind, normalized in itertools.product("bBhH", [False, True]):
        g = Gltf()
        g.use("KHR_mesh_quantization", True)
        unit = numpy.iinfo(TYPES[kind][1]).max
        scale = unit if normalized else 100
        values = numpy.round((numpy.array(CORNERS) + (0.5, 0, 0.5)) / 1.25 * scale)
        size = numpy.dtype(TYPES[kind][1]).itemsize
        position = g.accessor(values, kind, stride=4 if size == 1 else 8, normalized=normalized)
        g.mesh(g.primitive(position), node={"scale": [1.25 if normalized else 0.0125] * 3})
        yield f"quantized_{kind}_{'normalized' if normalized else 'plain'}", g
    for base, count in itertools.product([True, False], [1, 3]):
        g = Gltf()
        number = g.accessor(CORNERS)
        accessor = g.root["accessors"][number]
        rows = range(count) if base else range(12)
        accessor["sparse"] = {"count": len(rows),
                              "indices": {"bufferView": g.view(numpy.array(rows, "<u2").tobytes()), "componentType": 5123},
                              "values": {"bufferView": g.view(numpy.array([CORNERS[i] for i in rows], "<f4").tobytes())}}
        if not base:
            del accessor["bufferView"]
        g.mesh(g.primitive(number))
        yield f"sparse_{'base' if base else 'alone'}_{count}", g
    for base in (True, False):
        g = Gltf()
        number = g.accessor(FACES, "H", 1)
        rows = [0, 1, 2] if base else range(12)
        g.root["accessors"][number]["sparse"] = {
            "count": len(rows), "indices": {"bufferView": g.view(numpy.array(rows, "<u1").tobytes()), "componentType": 5121},
            "values": {"bufferView": g.view(numpy.array(FACES, "<u2").reshape(-1)[:len(rows)].tobytes())}}
        if not base:
            del g.root["accessors"][number]["bufferView"]
        g.mesh(g.primitive(POINTS, indices=number))
        yield f"sparse_indices_{'base' if base else 'alone'}", g
    for kind, width in itertools.product("fBH", [3, 4]):
        g = Gltf()
        top = 1 if kind == "f" else numpy.iinfo(TYPES[kind][1]).max
        colors = g.accessor([[top, 0, top / 2, top][:width]] * 12, kind, width, stride=4 if kind == "B" else None,
                            **({} if kind == "f" else {"normalized": True}))
        g.tetrahedron(attributes={"COLOR_0": colors})
        yield f"colors_{kind}_{width}", g
    g = Gltf()
    shared = g.accessor([*POINTS, (1e6, 1e6, 1e6)])
    g.mesh(*[g.primitive(shared, indices=g.accessor(face, "H", 1)) for face in FACES])
    yield "shared_vertices", g
    g = Gltf()
    g.tetrahedron(attributes={"NORMAL": g.accessor([(0, 0, 0)] * 12), "TANGENT": g.accessor([(0, 0, 0, 1)] * 12, "f", 4)})
    yield "zero_normals", g
    g = Gltf()
    g.mesh(g.primitive([POINTS[0]] * 3), g.primitive([(0, 0.5, 0), (1, 0.5, 0), (2, 0.5, 0)]))
    yield "degenerate", g


def materials():
    for mode, cutoff in itertools.product(["OPAQUE", "MASK", "BLEND"], [0, 0.5, 1, 2]):
        g = Gltf()
        g.material(alphaMode=mode, pbrMetallicRoughness={"baseColorFactor": [0.8, 0.2, 0.2, 0.5]},
                   **({"alphaCutoff": cutoff} if mode == "MASK" else {}))
        yield f"alpha_{mode}_{cutoff}", g
    for metallic, roughness, sides in itertools.product([0, 1], [0, 0.5, 1], [False, True]):
        g = Gltf()
        g.material(doubleSided=sides, pbrMetallicRoughness={"metallicFactor": metallic, "roughnessFactor": roughness})
        yield f"metal_{metallic}_rough_{roughness}_{'two' if sides else 'one'}_sided", g
    for color, strength in itertools.product([[1, 1, 1], [0, 0, 1], [0, 0, 0]], [None, 0, 5]):
        g = Gltf()
        extensions = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
        g.material(emissiveFactor=color, **({} if strength is None else {"extensions": extensions}))
        g.use("KHR_materials_emissive_strength")
        yield f"emission_{''.join(map(str, color))}_{strength}", g
    extensions = {"KHR_materials_unlit": {}, "KHR_materials_ior": {"ior": 1.33}, "KHR_materials_clearcoat": {},
                  "KHR_materials_specular": {"specularFactor": 0.5}, "KHR_materials_transmission": {"transmissionFactor": 1},
                  "KHR_materials_sheen": {}, "KHR_materials_volume": {}, "KHR_materials_anisotropy": {},
                  "KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.5, 0.5, 0.1, 1]}}
    for name, content in extensions.items():
        g = Gltf()
        g.use(name)
        g.material(extensions={name: content})
        yield f"material_{name}", g


def textures():
    for wrap, filters in itertools.product([10497, 33071, 33648], [9728, 9729, 9984, 9987, None]):
        g = Gltf()
        sampler = {"wrapS": wrap, "wrapT": wrap, **({} if filters is None else {"minFilter": filters})}
        g.textured({"bufferView": g.view(g.image()), "mimeType": "image/png"},
                   {**sampler, **({"magFilter": filters} if filters in (9728, 9729) else {})})
        yield f"sampler_{wrap}_{filters}", g
    for kind, mime in itertools.product(["PNG", "JPEG", "WEBP"], [True, False]):
        g = Gltf()
        webp = kind == "WEBP"
        image = {"bufferView": g.view(g.image(kind)), **({"mimeType": "image/" + kind.lower()} if mime else {})}
        g.textured(image, **({"extensions": {"EXT_texture_webp": {"source": 0}}} if webp else {}))
        if webp:
            del g.root["textures"][0]["source"]
            g.use("EXT_texture_webp", True)
        yield f"image_{kind}_{'mime' if mime else 'plain'}", g
    g = Gltf()
    g.textured({"bufferView": g.view(g.image("JPEG")[:-2])})
    yield "image_jpeg_without_end", g
    uris = {"a+b.png": "a+b.png", "a%20b.png": "a b.png", "50%.png": "50%.png", "x/../c.png": "c.png",
            "./d.png": "d.png", "sub%5Ce.png": "sub/e.png", "sub/f.png": "sub/f.png", "é.png": "é.png",
            "%C3%A9.png": "é.png", "a&b=c.png": "a&b=c.png", "a'b.png": "a'b.png"}
    for number, (uri, name) in enumerate(uris.items()):
        g = Gltf()
        g.textured({"uri": uri})
        g.files[name] = g.image()
        yield f"uri_{number}", g, "files"
    for number, head in enumerate(["data:image/png;base64,", "data:;base64,", "data:application/octet-stream;base64,"]):
        g = Gltf()
        g.textured({"uri": head + base64.b64encode(g.image()).decode()})
        yield f"data_uri_{number}", g, "data"
    for offset, scale, rotation in itertools.product([[0, 0], [0.5, -1]], [[1, 1], [-2, 0.5]], [0, 1]):
        g = Gltf()
        g.textured({"bufferView": g.view(g.image())})
        g.use("KHR_texture_transform", True)
        g.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
            "KHR_texture_transform": {"offset": offset, "scale": scale, "rotation": rotation}}
        yield f"texture_transform_{offset[1]}_{scale[0]}_{rotation}", g


def nodes():
    shear = [1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    transforms = [{"scale": [-1, 1, 1]}, {"scale": [-1, -1, 1]}, {"scale": [-1, -1, -1], "translation": [0, 2, 0]},
                  {"scale": [0, 1, 1]}, {"scale": [1, 0, 1]}, {"scale": [1e-3] * 3}, {"scale": [0.3, 2, 1]},
                  {"matrix": shear}, {"rotation": rotated((0, 1, 0), 40)}, {"translation": [0.5, 0.2, 0.5]},
                  {"rotation": [0, 0, 0, 1.005]}, {"matrix": [-v for v in shear[:15]] + [1]}]
    for number, node in enumerate(transforms):
        g = Gltf()
        g.tetrahedron(node=node)
        yield f"transform_{number}", g
        if "matrix" not in node:
            g = Gltf()
            child = g.tetrahedron(node=node)
            g.root["scenes"][0]["nodes"][-1] = g.add("nodes", {"children": [child], "scale": [1, 0.5, 1],
                                                               "rotation": rotated((0, 1, 0), 30)})
            yield f"transform_{number}_below", g
    for path, interpolation in itertools.product(["translation", "rotation", "scale"], ["LINEAR", "STEP", "CUBICSPLINE"]):
        g = Gltf()
        node = g.tetrahedron()
        keys = {"translation": [(0, 0, 0), (0, 1, 0)], "rotation": [rotated((0, 1, 0), 0), rotated((0, 1, 0), 90)],
                "scale": [(1, 1, 1), (1, 2, 1)]}[path]
        width = len(keys[0])
        if interpolation == "CUBICSPLINE":
            keys = [row for key in keys for row in ((0,) * width, key, (0,) * width)]
        g.animate(node, path, [0.5, 1], keys, interpolation, width)
        yield f"animated_{path}_{interpolation}", g
    g = Gltf()
    g.animate(g.tetrahedron(), "translation", [0, 1, 1, 2], [(0, 0, 0)] * 4)
    g.root["animations"][0]["channels"].append({"sampler": 0, "target": {"path": "translation"}})
    yield "animated_repeats_and_nobody", g
    for joints, sets, kind in itertools.product([1, 2], [1, 2], "Bf"):
        g = Gltf()
        weights = [[1 / sets / min(joints, 2)] * min(joints, 2) + [0] * (4 - min(joints, 2))] * 12
        attributes = {}
        for number in range(sets):
            attributes[f"JOINTS_{number}"] = g.accessor([[0, joints - 1, 0, 0]] * 12, "H" if number else "B", 4)
            attributes[f"WEIGHTS_{number}"] = g.accessor(
                numpy.round(numpy.array(weights) * 255) if kind == "B" else weights, kind, 4,
                **({"normalized": True} if kind == "B" else {}))
        g.tetrahedron(node={"skin": 0, "translation": [50, 0, 0]}, attributes=attributes)
        bones = [g.add("nodes", {"translation": [0.2 * i, 0.1, 0]}) for i in range(joints)]
        g.root["scenes"][0]["nodes"] += bones
        identity = numpy.identity(4).T.reshape(1, 16)
        g.add("skins", {"joints": bones, **({"inverseBindMatrices": g.accessor(numpy.repeat(identity, joints, 0), "f", 16)}
                                            if sets == 1 else {})})
        yield f"skin_{joints}_{sets}_{kind}", g
    for weights, own in itertools.product([None, [0.5, 0], [1, -1]], [None, [1, 0]]):
        g = Gltf()
        target = {"POSITION": g.accessor([(0, 0.4, 0)] * 12)}
        number = g.tetrahedron(targets=[target, target], **{})
        if weights:
            g.root["meshes"][1]["weights"] = weights
        if own:
            g.root["nodes"][number]["weights"] = own
        yield f"morph_{weights[1] if weights else 'none'}_{'own' if own else 'mesh'}", g
    for interpolation in ["LINEAR", "STEP", "CUBICSPLINE"]:
        g = Gltf()
        targets = [{"POSITION": g.accessor([(0, 0.4, 0)] * 12)}, {"POSITION": g.accessor([(0.2, 0, 0)] * 12)}]
        number = g.tetrahedron(targets=targets)
        keys = [(0, 0), (1, 0.5)]
        if interpolation == "CUBICSPLINE":
            keys = [row for key in keys for row in ((0, 0), key, (0, 0))]
        g.animate(number, "weights", [0.5, 1], [weight for row in keys for weight in row], interpolation, 1)
        yield f"animated_weights_{interpolation}", g
    for kinds in itertools.chain.from_iterable(itertools.combinations(["perspective", "orthographic"], n) for n in (1, 2)):
        g = Gltf()
        g.tetrahedron()
        for kind in kinds:
            lens = {"yfov": 0.8, "znear": 0.1} if kind == "perspective" else {"xmag": 2, "ymag": 2, "znear": 0, "zfar": 9}
            camera = g.add("cameras", {"type": kind, kind: lens})
            g.root["scenes"][0]["nodes"].append(g.add("nodes", {"camera": camera, "translation": [0, 1, 5]}))
        yield "camera_" + "_".join(kinds), g
    for kind in ["point", "spot", "directional"]:
        g = Gltf()
        g.tetrahedron()
        g.use("KHR_lights_punctual")
        light = {"type": kind, "intensity": 20, **({"spot": {"outerConeAngle": math.pi / 2}} if kind == "spot" else {})}
        g.root["extensions"] = {"KHR_lights_punctual": {"lights": [light]}}
        g.root["scenes"][0]["nodes"].append(g.add("nodes", {
            "translation": [0, 3, 0], "rotation": rotated((1, 0, 0), -90),
            "extensions": {"KHR_lights_punctual": {"light": 0}}}))
        yield f"light_{kind}", g
    g = Gltf()
    places = {"TRANSLATION": g.accessor([(-1, 0, 0), (1, 0, 0)]), "ROTATION": g.accessor([rotated((0, 1, 0), 30)] * 2, "f", 4)}
    g.tetrahedron(node={"extensions": {"EXT_mesh_gpu_instancing": {"attributes": places}}})
    g.use("EXT_mesh_gpu_instancing", True)
    yield "instancing", g
    g = Gltf()
    g.tetrahedron(node={"extensions": {"KHR_node_visibility": {"visible": False}}})
    g.use("KHR_node_visibility")
    yield "hidden", g
    for name in ["été", "名前", "a/b\\c", "tab\there", "", "x" * 3000]:
        g = Gltf()
        g.tetrahedron(node={"name": name})
        for container in ("glb", "files", "data"):
            yield f"name_{len(name)}_{container}", g, container


def refused():
    """Each has one fault that can't be read around."""
    def changed(name, change, container="glb"):
        g = Gltf()
        g.tetrahedron()
        change(g)
        return name, g, container

    def put(path, value):
        def change(g):
            at = g.root
            for key in path[:-1]:
                at = at[key]
            at[path[-1]] = value
        return change

    last = ["meshes", 1, "primitives", 0]
    for name, path, value in [
            ("version_1", ["asset", "version"], "1.0"), ("version_3", ["asset", "version"], "3.0"),
            ("min_version", ["asset", "minVersion"], "2.1"), ("required", ["extensionsRequired"], ["EXT_unheard_of"]),
            ("accessor_missing", last + ["attributes", "POSITION"], 99), ("mode_9", last + ["mode"], 9),
            ("indices_missing", last + ["indices"], 99), ("material_missing", last + ["material"], 5),
            ("view_missing", ["accessors", 1, "bufferView"], 99), ("count_too_big", ["accessors", 2, "count"], 10 ** 9),
            ("count_negative", ["accessors", 2, "count"], -3), ("type_unknown", ["accessors", 2, "type"], "VEC5"),
            ("component_unknown", ["accessors", 2, "componentType"], 5000), ("shape", ["accessors", 2, "type"], "VEC2"),
            ("view_outside", ["bufferViews", 1, "byteLength"], 10 ** 8), ("child_missing", ["nodes", 1, "children"], [9]),
            ("cycle", ["nodes", 1, "children"], [1]), ("scene_missing", ["scene"], 4),
            ("mesh_missing", ["nodes", 1, "mesh"], 7), ("far", ["nodes", 1, "translation"], [1e20, 0, 0]),
            ("huge", ["nodes", 1, "scale"], [1e12, 1, 1]), ("empty", ["scenes", 0, "nodes"], []),
            ("buffer_too_long", ["buffers"], [{"byteLength": 10 ** 6}]),
            ("rotation_zero", ["nodes", 1, "rotation"], [0, 0, 0, 0]), ("matrix_short", ["nodes", 1, "matrix"], [1, 2])]:
        yield changed(name, put(path, value))
    for name, value in [("nan", math.nan), ("infinite", math.inf), ("1e20", 1e20), ("1.9e18", 1.9e18), ("2e9", 2e9)]:
        def change(g, value=value):
            g.mesh(g.primitive([(0, 0, 0), (value, 0, 0), (0, 1, 0)]))
            g.root["accessors"][-1].pop("min"), g.root["accessors"][-1].pop("max")
        yield changed("position_" + name, change)
    for name, uri in [("above", "../up.bin"), ("absolute", "/etc/hostname"), ("coded", "%2e%2e/up.bin"),
                      ("web", "https://host/a.bin"), ("missing", "nowhere.bin"), ("data", "data:;base64,AAAA")]:
        yield changed("uri_" + name, lambda g, uri=uri: g.root.update(
            buffers=[{"uri": uri, "byteLength": len(g.data)}]), "files")
    for name, image in [("ktx2", b"\xabKTX 20\xbb\r\n\x1a\n" + b"\0" * 64), ("cut", None), ("nothing", b"?" * 40)]:
        g = Gltf()
        g.textured({"bufferView": g.view(image or g.image()[:-30])})
        yield "image_" + name, g, "glb"


def cases():
    """Triples: name, file, container; and whether it is to be read."""
    for family in (meshes, materials, textures, nodes):
        for name, g, *container in family():
            yield f"{family.__name__}_{name}", g, container[0] if container else "glb", True
    for name, g, container in refused():
        yield f"refused_{name}", g, container, False


def write_cases(folder):
    """@return what cases.json says: for each file's path whether it is to be read"""
    expected = {}
    for name, g, container, good in cases():
        place = folder / name
        place.mkdir(parents=True, exist_ok=True)
        expected[str(g.write(place / "scene", container).relative_to(folder))] = good
    (folder / "cases.json").write_text(json.dumps(expected, indent=1))
    return expected


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print(f"{len(write_cases(pathlib.Path(sys.argv[1])))} files")
