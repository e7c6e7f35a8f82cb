#!/usr/bin/python3
"""Checks who includes whom: the layers of docs/architecture.md, one place for each third-party library.

layers.py [ROOT]: prints "file:line: problem" for each broken rule; exit status 1 where there is one.
"""
import os
import re
import sys

# A layer may include itself and what stands here.
LAYERS = {
    "base": set(),
    "vulkan": {"base"},
    "image": {"base"},
    "scene": {"base", "image"},
    "trace": {"base", "image", "scene", "vulkan"},
    "graph": {"base", "image", "scene", "vulkan", "trace"},
    "config": {"base", "image", "scene", "vulkan", "trace"},
    "experiment": {"base", "image", "scene", "vulkan", "trace", "graph", "config"},
    "app": {"base", "image", "scene", "vulkan", "trace", "graph", "config", "experiment"},
}

# What techniques share: passes/common/<room> and shaders/<room>. A room may use itself and what stands here.
ROOMS = {
    "compute": set(),
    "view": {"compute"},
    "filter": {"compute", "view"},
    "voxels": {"compute", "view"},
    "triangle_walk": {"compute", "voxels"},
    "voxel_builder": {"compute", "voxels", "triangle_walk"},
    "octree": {"compute", "voxels"},
    "voxel_march": {"compute", "voxels", "octree"},
    "hybrid_leaves": {"compute", "voxels", "octree", "voxel_march"},
    "radiance": {"compute", "voxels", "octree"},
    "clipmap": {"compute", "voxels", "radiance"},
    "lights": {"compute", "view", "voxels"},
    "light_paths": {"compute", "voxels", "lights"},
    "clusters": {"compute", "voxels", "surfels"},
    "vpls": {"compute"},
    "surfels": {"compute", "view", "voxels", "lights"},
    "final_gather": {"compute", "view", "filter", "lights", "surfels"},
    "radiance_cache": {"compute"},
    "irradiance_tree": {"compute", "voxels"},
    "packed_voxels": {"compute", "voxels"},
}

# GLSL of the framework's own things, for every room.
SHADER_BASE = {"shared", "scene", "trace"}

# What a technique may use of the framework.
PASSES_MAY_USE = LAYERS["graph"] | {"graph"}

# Third-party headers and the only places that may include them.
THIRD_PARTY = {
    r"tiny_gltf\.h": ["framework/scene/"],
    r"embree\d*/": ["framework/trace/embree_api.h"],
    r"(draco|meshoptimizer)": ["framework/scene/", "tests/unit/compressed_gltf.h"],
    r"OpenImageIO/": ["framework/image/", "tests/unit/image_layers_test.cpp"],
    r"yaml-cpp/": ["framework/config/yaml.cpp"],
    r"vulkan/vulkan": ["framework/vulkan/", "framework/trace/", "tests/"],
    r"(glslang|SPIRV|spirv_cross)/": ["framework/vulkan/"],
    r"CLI/": ["framework/app/"],
    r"xxhash\.h": ["framework/base/"],
    r"gtest/": ["tests/"],
    r"benchmark/": ["tests/"],
}

SOURCE = re.compile(r"\.(h|hpp|cpp|glsl|comp|vert|geom|frag|rgen|rmiss|rchit|rahit)$")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def sources(root):
    for top in ("framework", "passes", "shaders", "tests"):
        for folder, folders, files in os.walk(os.path.join(root, top)):
            folders.sort()
            for name in sorted(files):
                if SOURCE.search(name):
                    yield os.path.relpath(os.path.join(folder, name), root)


def resolve(root, includer, target):
    """The included file relative to the root, as the compilers find it; None where it is not ours."""
    for base in (os.path.dirname(includer), "framework", "."):
        path = os.path.normpath(os.path.join(base, target))
        if os.path.isfile(os.path.join(root, path)):
            return path
    return None


def technique(path):
    """Folder under passes/, or None for what all techniques share."""
    parts = path.split("/")
    return parts[1] if parts[0] == "passes" and len(parts) > 2 and parts[1] != "common" else None


def room(path):
    """The room of a file, None where it is in none."""
    parts = path.split("/")
    if path.startswith("passes/common/") and len(parts) > 3:
        return parts[2]
    return parts[1] if parts[0] == "shaders" and len(parts) > 2 and parts[1] not in SHADER_BASE else None


def problem_of_rooms(includer, included):
    for path in (includer, included):
        if path.startswith("passes/common/") and room(path) is None:
            return f"{path} is in no room: passes/common/<room>/"
        if room(path) is not None and room(path) not in ROOMS:
            return f"room {room(path)} is not known: add it to tests/house/layers.py"
    mine, other = room(includer), room(included)
    if mine and other and mine != other and other not in ROOMS[mine]:
        return f"room {mine} includes {included}: it may include {', '.join(sorted(ROOMS[mine])) or 'no room'}"
    if includer.startswith("shaders/") and mine is None and other:
        return f"{includer} includes {included}: the scene's own GLSL knows no room"
    return None


def problem_of_own(includer, included):
    rooms = problem_of_rooms(includer, included)
    if rooms:
        return rooms
    if included.startswith("shaders/"):
        return None
    if includer.startswith("shaders/"):
        return f"shaders/ includes {included}: the shader library knows nothing outside itself"
    if includer.startswith("framework/"):
        layer = includer.split("/")[1]
        if layer not in LAYERS:
            return None if layer == "report" else f"framework/{layer} is in no layer: add it to tests/house/layers.py"
        if included.startswith("passes/"):
            return None if layer == "app" else f"framework/{layer} includes {included}: only app knows the passes"
        if included.startswith("framework/"):
            other = included.split("/")[1]
            if other != layer and other not in LAYERS[layer]:
                return f"layer {layer} includes {included}: it may include {', '.join(sorted(LAYERS[layer])) or 'no layer'}"
    if includer.startswith("passes/"):
        if included.startswith("framework/") and included.split("/")[1] not in PASSES_MAY_USE:
            return f"a pass includes {included}: passes know {', '.join(sorted(PASSES_MAY_USE))}"
        mine, other = technique(includer), technique(included)
        if other and mine != other and not includer.startswith("passes/register_passes"):
            return f"{includer} includes {included}: techniques meet in passes/common/, shaders/ and graph resources"
    if included.startswith("tests/") and not includer.startswith("tests/"):
        return f"{includer} includes {included}: nothing but tests includes tests"
    return None


def problem_of_third_party(includer, header):
    for pattern, places in THIRD_PARTY.items():
        if re.match(pattern, header) and not any(includer.startswith(place) for place in places):
            return f"<{header}> may only be included in {', '.join(places)}"
    return None


# A shader that C++ names, to compile it, is used as if it were included.
SHADER = re.compile(r'(?<!#include )"((?:framework|passes|shaders|tests)/[\w/]+\.(?:comp|vert|geom|frag|glsl))"')


def check(root):
    problems = []
    for path in sources(root):
        with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
            for number, line in enumerate(file, 1):
                problems += [f"{path}:{number}: {problem}" for shader in SHADER.findall(line)
                             if (problem := problem_of_own(path, shader))]
                match = INCLUDE.match(line)
                if not match:
                    continue
                own = resolve(root, path, match[2]) if match[1] == '"' else None
                problem = problem_of_own(path, own) if own else problem_of_third_party(path, match[2])
                if problem:
                    problems.append(f"{path}:{number}: {problem}")
    return problems


if __name__ == "__main__":
    found = check(sys.argv[1] if len(sys.argv) > 1 else ".")
    print("\n".join(found) or "layers: all includes follow the rules")
    sys.exit(1 if found else 0)
