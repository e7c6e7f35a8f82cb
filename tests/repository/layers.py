#!/usr/bin/python3
"""Checks who includes whom: the layers of docs/architecture.md, one place for each third-party library.

layers.py [ROOT]: prints "file:line: problem" for each broken rule; exit status 1 where there is one.
"""
import functools
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

# Families of techniques, passes/<family>. One may use itself, passes/common, shaders and what stands here; of other
# families what they share, not their techniques (folders that register a pass).
FAMILIES = {
    "view": {"cones", "clusters", "surfels"},
    "voxels": set(),
    "inject": {"surfels"},
    "surfels": set(),
    "radiosity": {"surfels"},
    "clusters": {"surfels"},
    "cones": {"surfels", "path_trace"},
    "final_gather": {"surfels", "cache", "path_trace"},
    "cache": {"surfels"},
    "probes": {"surfels"},
    "reservoirs": set(),
    "vpls": {"surfels", "inject", "hybrid_leaves"},
    "hybrid_leaves": {"surfels", "cones"},
    "published": {"cones"},
    "path_trace": set(),
    "external": set(),
    "experiments": {"cones", "surfels"},
}

# What families share: passes/common/<module> and shaders/<module>. A module may use itself and what stands here.
MODULES = {
    "compute": set(),
    "view": {"compute"},
    "filter": {"compute", "view"},
    "voxels": {"compute", "view"},
    "triangle_voxelizer": {"compute", "voxels"},
    "voxel_builder": {"compute", "voxels", "triangle_voxelizer"},
    "octree": {"compute", "voxels"},
    "voxel_march": {"compute", "voxels", "octree"},
    "lights": {"compute", "view", "voxels"},
}

# GLSL of the framework's own things, for every module.
SHADER_BASE = {"shared", "scene", "trace"}

# The list of families, which adds them all.
FAMILY_LIST = "passes/common/families."

# What a technique may use of the framework.
PASSES_MAY_USE = LAYERS["graph"] | {"graph"}

# Third-party headers and the only places that may include them.
THIRD_PARTY = {
    r"tiny_gltf\.h": ["framework/scene/"],
    r"embree\d*/": ["framework/trace/embree_api.h"],
    r"pugixml\.hpp": ["framework/scene/mitsuba/document.cpp"],
    r"zlib\.h": ["framework/scene/import/inflate.cpp", "tests/unit/import_mesh_test.cpp", "tests/unit/mitsuba_files.h",
                 "tests/unit/pbrt_reading_test.cpp"],
    r"(draco|meshoptimizer)": ["framework/scene/", "tests/unit/compressed_gltf.h"],
    r"OpenImageIO/": ["framework/image/", "tests/unit/image_layers_test.cpp"],
    r"yaml-cpp/": ["framework/config/yaml.cpp"],
    r"vulkan/vulkan": ["framework/vulkan/", "framework/trace/", "tests/"],
    r"(glslang|SPIRV|spirv_cross)/": ["framework/vulkan/"],
    r"CLI/": ["framework/app/"],
    r"httplib\.h": ["framework/app/look_server.cpp"],
    r"xxhash\.h": ["framework/base/"],
    r"gtest/": ["tests/", "docs/examples/"],
    r"benchmark/": ["tests/"],
}

# What nothing of the program includes.
OUTER = ("tests/", "docs/examples/")

SOURCE = re.compile(r"\.(h|hpp|cpp|glsl|comp|vert|geom|frag|rgen|rmiss|rchit|rahit)$")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def sources(root):
    for top in ("framework", "passes", "shaders", "tests", "docs/examples"):
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


def family(path):
    """Folder under passes/, or None for what all families share."""
    parts = path.split("/")
    return parts[1] if parts[0] == "passes" and len(parts) > 2 and parts[1] != "common" else None


def technique(root, path):
    """The folder of a file's pass, None where it belongs to no single one."""
    parts = path.split("/")
    for count in range(3, len(parts)):
        folder = "/".join(parts[:count])
        if family(path) and registers(root, folder):
            return folder
    return None


@functools.cache
def registers(root, folder):
    """Whether a source of the folder itself registers a pass."""
    place = os.path.join(root, folder)
    for name in sorted(os.listdir(place)) if os.path.isdir(place) else []:
        if name.endswith(".cpp"):
            with open(os.path.join(place, name), encoding="utf-8") as file:
                if "VOXRAY_REGISTER_PASS(" in file.read():
                    return True
    return False


def module(path):
    """The module of a file that families share, None where it is in none."""
    parts = path.split("/")
    if path.startswith("passes/common/") and len(parts) > 3:
        return parts[2]
    return parts[1] if parts[0] == "shaders" and len(parts) > 2 and parts[1] not in SHADER_BASE else None


def problem_of_modules(includer, included):
    for path in (includer, included):
        if path.startswith("passes/common/") and module(path) is None and not path.startswith(FAMILY_LIST):
            return f"{path} is in no module: passes/common/<module>/"
        if module(path) is not None and module(path) not in MODULES:
            return f"module {module(path)} is not known: add it to tests/repository/layers.py"
        if family(path) is not None and family(path) not in FAMILIES and not includer.startswith("tests/"):
            return f"family {family(path)} is not known: add it to tests/repository/layers.py"
    mine, other = module(includer), module(included)
    if mine and other and mine != other and other not in MODULES[mine]:
        return f"module {mine} includes {included}: it may include {', '.join(sorted(MODULES[mine])) or 'no module'}"
    if includer.startswith("shaders/") and mine is None and other:
        return f"{includer} includes {included}: the scene's own GLSL knows no module"
    return None


def problem_of_families(root, includer, included):
    mine, other = family(includer), family(included)
    if other is None:
        return None
    if mine is None:
        return None if includer.startswith(FAMILY_LIST) else f"{includer} includes {included}: what families share knows none"
    if mine != other and other not in FAMILIES[mine]:
        return f"family {mine} includes {included}: it may include {', '.join(sorted(FAMILIES[mine])) or 'no family'}"
    if technique(root, included) not in (None, technique(root, includer)):
        return f"{includer} includes {included}: techniques meet in their family, passes/common/ and graph resources"
    return None


def problem_of_own(root, includer, included):
    modules = problem_of_modules(includer, included)
    if modules:
        return modules
    if included.startswith("shaders/"):
        return None
    if includer.startswith("shaders/"):
        return f"shaders/ includes {included}: the shader library knows nothing outside itself"
    if includer.startswith("framework/"):
        layer = includer.split("/")[1]
        if layer not in LAYERS:
            return None if layer == "report" else f"framework/{layer} is in no layer: add it to tests/repository/layers.py"
        if included.startswith("passes/"):
            return None if layer == "app" else f"framework/{layer} includes {included}: only app knows the passes"
        if included.startswith("framework/"):
            other = included.split("/")[1]
            if other != layer and other not in LAYERS[layer]:
                return f"layer {layer} includes {included}: it may include {', '.join(sorted(LAYERS[layer])) or 'no layer'}"
    if includer.startswith("passes/"):
        if included.startswith("framework/") and included.split("/")[1] not in PASSES_MAY_USE:
            return f"a pass includes {included}: passes know {', '.join(sorted(PASSES_MAY_USE))}"
        problem = problem_of_families(root, includer, included)
        if problem:
            return problem
    if included.startswith(OUTER) and not includer.startswith(OUTER):
        return f"{includer} includes {included}: nothing but tests and examples includes these"
    return None


def problem_of_third_party(includer, header):
    for pattern, places in THIRD_PARTY.items():
        if re.match(pattern, header) and not any(includer.startswith(place) for place in places):
            return f"<{header}> may only be included in {', '.join(places)}"
    return None


# A shader that C++ names, to compile it, is used as if it were included: next to the file or from the root.
SHADER = re.compile(r'(?<!#include )"([\w./]+\.(?:comp|vert|geom|frag|glsl))"')


def check(root):
    problems = []
    for path in sources(root):
        with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
            for number, line in enumerate(file, 1):
                problems += [f"{path}:{number}: {problem}" for shader in SHADER.findall(line)
                             if (problem := problem_of_own(root, path, resolve(root, path, shader) or shader))]
                match = INCLUDE.match(line)
                if not match:
                    continue
                own = resolve(root, path, match[2]) if match[1] == '"' else None
                problem = problem_of_own(root, path, own) if own else problem_of_third_party(path, match[2])
                if problem:
                    problems.append(f"{path}:{number}: {problem}")
    return problems


if __name__ == "__main__":
    found = check(sys.argv[1] if len(sys.argv) > 1 else ".")
    print("\n".join(found) or "layers: all includes follow the rules")
    sys.exit(1 if found else 0)
