"""Random scenes that are awkward by intention, as .glb files, each the same for the same seed."""

import json
import struct

import numpy as np

BOX_CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
# Corners of a box's faces, counter-clockwise seen from outside
BOX_FACES = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))


class Builder:
    """Collects quads and triangles by material, lights and a camera."""

    def __init__(self):
        self.triangles = {}  # By material: n x 3 x 3
        self.materials = []
        self.lights = []
        self.camera = None

    def material(self, albedo, emission=0.0, double_sided=False):
        self.materials.append((albedo, emission, double_sided))
        return len(self.materials) - 1

    def triangle(self, corners, material):
        self.triangles.setdefault(material, []).append(np.asarray(corners, float))

    def quad(self, corners, material):
        a, b, c, d = np.asarray(corners, float)
        self.triangle([a, b, c], material)
        self.triangle([a, c, d], material)

    def box(self, low, high, material, inwards=False, without=()):
        corners = low + BOX_CORNERS * (np.asarray(high) - low)
        for face, indices in enumerate(BOX_FACES):
            if face not in without:
                self.quad(corners[list(indices[::-1] if inwards else indices)], material)

    def bounds(self):
        points = np.concatenate([np.reshape(t, (-1, 3)) for t in self.triangles.values()])
        return points.min(axis=0), points.max(axis=0)

    def typical_radiance(self):
        """What all surfaces would send out if the lights' power fell on them evenly and none was lost: power / (pi area), W/(m² sr)."""
        area_of = lambda t: np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1).sum() / 2
        areas = {material: area_of(np.array(triangles)) for material, triangles in self.triangles.items()}
        area, power = sum(areas.values()), 0.0
        for kind, _, strength in self.lights:
            solid_angle = {"point": 4 * np.pi, "spot": 2 * np.pi * (1 - np.cos(0.6))}.get(kind)
            power += strength * (solid_angle if solid_angle else area / 6)  # A sun falls on a sixth of a box
        power += sum(np.pi * self.materials[m][1] * a for m, a in areas.items())
        return power / (np.pi * area)

    def write(self, path, scale, origin):
        place = lambda p: (np.asarray(p, float) * scale + origin)
        data, views, accessors, meshes, nodes = b"", [], [], [], []
        for material, triangles in self.triangles.items():
            points = place(np.reshape(triangles, (-1, 3))).astype(np.float32)
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": points.nbytes})
            accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": len(points), "type": "VEC3",
                              "min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()})
            data += points.tobytes()
            meshes.append({"primitives": [{"attributes": {"POSITION": len(accessors) - 1}, "material": material}]})
            nodes.append({"mesh": len(meshes) - 1})
        lights = []
        for kind, where, strength in self.lights:
            light = {"type": kind, "intensity": 1.0, "color": [1, 1, 1]}
            light["intensity"] = float(strength * (scale ** 2 if kind != "directional" else 1))
            if kind == "spot":
                light["spot"] = {"innerConeAngle": 0.3, "outerConeAngle": 0.9}
            node = {"extensions": {"KHR_lights_punctual": {"light": len(lights)}}}
            if kind == "point":
                node["translation"] = place(where).tolist()
            else:
                node["translation"] = place(where[0]).tolist()
                node["rotation"] = rotation_to(where[1])
            lights.append(light)
            nodes.append(node)
        gltf = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
            "meshes": meshes, "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data)}],
            "materials": [{
                "pbrMetallicRoughness": {"baseColorFactor": [albedo, albedo, albedo, 1], "metallicFactor": 0},
                "doubleSided": double_sided,
                **({"emissiveFactor": [1, 1, 1], "extensions": {
                    "KHR_materials_emissive_strength": {"emissiveStrength": emission}}} if emission else {}),
            } for albedo, emission, double_sided in self.materials],
            "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength"],
            "extensions": {"KHR_lights_punctual": {"lights": lights}} if lights else {},
        }
        if not lights:
            del gltf["extensions"]
        text = json.dumps(gltf).encode()
        text += b" " * (-len(text) % 4)
        data += b"\0" * (-len(data) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(data)))
            file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
            file.write(struct.pack("<II", len(data), 0x004E4942) + data)


def rotation_to(direction):
    """A quaternion xyzw that turns -z to a direction."""
    d = np.asarray(direction, float) / np.linalg.norm(direction)
    half = d + [0, 0, -1]
    if np.linalg.norm(half) < 1e-6:
        return [0.0, 1.0, 0.0, 0.0]
    half /= np.linalg.norm(half)
    return [*np.cross([0, 0, -1], half).tolist(), float(half @ [0, 0, -1])]


def on_border(rng, low, high, resolution, axis):
    """A coordinate on a border between voxels of the grid over bounds, as makeVoxelGrid() lays it."""
    size = (high - low).max() / (resolution - 0.25)
    voxels = np.clip(np.ceil((high - low)[axis] / size + 0.25 - 1e-4), 1, resolution)
    origin = 0.5 * (low + high)[axis] - 0.5 * size * voxels
    return origin + size * rng.integers(1, max(int(voxels), 2))


def make(seed, path):
    """Writes a scene. @return the config's map `scene`, its resolution, what is awkward about it, and its typical radiance."""
    rng = np.random.default_rng(seed)
    uniform = rng.uniform
    b, tags = Builder(), []
    size = uniform(1, 4, 3) * [1, 0.7, 1]
    resolution = int(rng.choice([16, 24, 32, 48, 64]))
    gray = lambda: b.material(float(uniform(0.2, 0.8)), double_sided=bool(rng.random() < 0.3))
    low, high = -size, size
    is_closed = rng.random() < 0.6
    tags.append("room" if is_closed else "open")
    if is_closed:
        b.box(low, high, gray(), inwards=True, without=(5,) if rng.random() < 0.3 else ())
    else:
        b.quad([[low[0], low[1], high[2]], [high[0], low[1], high[2]], [high[0], low[1], low[2]],
                [low[0], low[1], low[2]]], gray())
        b.quad([[low[0], low[1], low[2]], [high[0], low[1], low[2]], [high[0], high[1], low[2]],
                [low[0], high[1], low[2]]], gray())

    # The camera keeps a quarter of the room to itself
    camera = np.array([uniform(-0.3, 0.3), uniform(-0.2, 0.2), 0.85]) * size
    target = np.array([uniform(-0.5, 0.5), uniform(-0.6, 0), -0.5]) * size
    place = lambda: np.array([*uniform(-0.8, 0.8, 2), uniform(-0.9, 0.3)]) * size
    for _ in range(rng.integers(0, 6)):
        center, half = place(), uniform(0.05, 0.3, 3) * size
        center[2] = min(center[2], 0.3 * size[2])
        half = np.minimum(half, 0.95 * size - np.abs(center))
        b.box(center - half, center + half, gray())
    if rng.random() < 0.5:
        tags.append("sheets on borders")
        for _ in range(rng.integers(1, 4)):
            axis = int(rng.integers(3))
            u, v = (axis + 1) % 3, (axis + 2) % 3
            at = on_border(rng, low, high, resolution, axis)
            if axis == 2:
                at = min(at, on_border(rng, low, high, resolution, axis), 0.3 * size[2])
            if abs(at) >= size[axis] or (axis != 2 and abs(at - camera[axis]) < 0.1 * size[axis]):
                continue
            center, half = uniform(-0.5, 0.3, 3) * size, uniform(0.2, 0.5, 3) * size
            corners = []
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = np.zeros(3)
                p[axis], p[u], p[v] = at, center[u] + x * half[u], center[v] + y * half[v]
                corners.append(np.clip(p, low, high))
            b.quad(corners, gray())
    if rng.random() < 0.3:
        tags.append("slivers")
        for _ in range(rng.integers(1, 30)):
            a, way = place(), uniform(-1, 1, 3) * size
            width = way[[1, 2, 0]] * 10 ** uniform(-7, -2)
            b.triangle(np.clip([a, a + way, a + way + width], low, np.minimum(high, [9e9, 9e9, 0.5 * size[2]])), gray())
    if rng.random() < 0.3:
        tags.append("nested room")
        center, half = np.array([0, -0.1, -0.45]) * size, 0.35 * size
        b.box(center - half, center + half, gray(), inwards=True, without=(5,))
        b.box(center - 1.02 * half, center + 1.02 * half, gray(), without=(5,))
    if rng.random() < 0.25:
        tags.append("thin gap")
        y = low[1] + 10 ** uniform(-3, -1) * size[1]
        x, z = uniform(0.2, 0.6, 2) * size[[0, 2]]
        b.quad([[-x, y, 0.4 * z], [x, y, 0.4 * z], [x, y, -z], [-x, y, -z]], gray())

    # Lights: in a closed room at its top, else also a sun
    for _ in range(rng.integers(1, 4)):
        kind = rng.choice(["point", "spot", "emissive"] + ([] if is_closed else ["directional"] * 2))
        where = np.array([uniform(-0.7, 0.7), uniform(0.5, 0.9), uniform(-0.5, 0.8)]) * size
        tags.append(str(kind))
        if kind == "point":
            b.lights.append(("point", where, uniform(5, 50)))
        elif kind == "spot":
            b.lights.append(("spot", (where, [uniform(-0.3, 0.3), -1, uniform(-0.3, 0.3)]), uniform(20, 80)))
        elif kind == "directional":
            b.lights.append(("directional", (where, [uniform(-0.5, 0.5), -1, uniform(-0.8, -0.1)]), uniform(1, 10)))
        else:
            x, z = uniform(0.05, 0.3, 2) * size[[0, 2]]
            lamp = b.material(0.5, emission=float(uniform(2, 20)))
            b.quad([where + [-x, 0, -z], where + [x, 0, -z], where + [x, 0, z], where + [-x, 0, z]], lamp)

    # Where all that is
    scale = 10 ** uniform(-3, 5)
    origin = uniform(-1, 1, 3) * scale * rng.choice([0, 0, 1, 20])
    if scale * size.max() > 1e5 or np.abs(origin).max() > 5e5:
        scale, origin = 1e4, np.zeros(3)
    scene, typical = {"file": path}, b.typical_radiance()
    if rng.random() < 0.25:
        tags.append("stray triangle")
        box = b.bounds()
        away = rng.choice([-1, 1], 3) * min(10 ** uniform(1, 5) * size.max(), 9e8 / scale)  # Voxray reads coordinates up to 1e9 m
        b.triangle(away + uniform(-1, 1, (3, 3)) * size, gray())
        scene["region"] = {key: (corner * scale + origin).tolist() for key, corner in zip(("min", "max"), box)}
    tags.append(f"scale {scale:.1e}")
    b.write(path, scale, origin)
    scene["camera"] = {"position": (camera * scale + origin).tolist(), "target": (target * scale + origin).tolist(),
                       "fov_deg": 70}
    scene["materials"] = "lambert"
    return scene, resolution, tags, typical
