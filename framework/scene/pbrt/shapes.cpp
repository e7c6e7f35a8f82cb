#include "scene/pbrt/shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <numbers>

#include "base/suggest.h"
#include "scene/import/loop_subdivision.h"
#include "scene/import/mesh_normals.h"
#include "scene/import/ply.h"
#include "scene/import/shapes.h"
#include "scene/pbrt/files.h"

namespace voxray::pbrt {
namespace {

using std::numbers::pi;

struct Reader {
    const Parameters& parameters;
    const std::filesystem::path& folder;
    SceneImport& import;
};

/// Indices of vertices, in groups.
std::vector<uint32_t> indicesOf(const Parameters& p, size_t vertexCount, size_t each) {
    const std::vector<double> numbers = p.numbers("indices");
    if (numbers.size() % each != 0) p.fail("'indices' has {} numbers; a face has {}", numbers.size(), each);
    std::vector<uint32_t> indices;
    indices.reserve(numbers.size());
    for (const double number : numbers) {
        if (!(number >= 0 && number < double(vertexCount)) || number != std::floor(number))
            p.fail("'indices' names vertex {}, but 'P' has {} of them", number, vertexCount);
        indices.push_back(uint32_t(number));
    }
    if (!indices.empty()) return indices;
    if (vertexCount != each) p.fail("it has no 'indices', and 'P' has {} vertices, not {}", vertexCount, each);
    for (uint32_t i = 0; i < each; ++i) indices.push_back(i);
    return indices;
}

Mesh controlMesh(const Parameters& p) {
    Mesh mesh;
    mesh.positions = p.points3("P");
    if (mesh.positions.empty()) p.fail("it has no vertices 'P'");
    const std::vector<uint32_t> indices = indicesOf(p, mesh.positions.size(), 3);
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        mesh.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    return mesh;
}

void checkCount(const Parameters& p, const char* name, size_t count, const Mesh& mesh) {
    if (count != 0 && count != mesh.positions.size())
        p.fail("'{}' has {} values, but 'P' has {} vertices", name, count, mesh.positions.size());
}

Mesh triangleMesh(const Reader& r) {
    const Parameters& p = r.parameters;
    Mesh mesh = controlMesh(p);
    mesh.normals = p.points3("N");
    mesh.texCoords0 = p.points2("uv");
    checkCount(p, "N", mesh.normals.size(), mesh);
    checkCount(p, "uv", mesh.texCoords0.size(), mesh);
    p.ignore({"S", "faceIndices"});
    return mesh;
}

Mesh plyMesh(const Reader& r) {
    const std::string name = r.parameters.text("filename", "");
    if (name.empty()) r.parameters.fail("a plymesh needs a 'filename'");
    const std::filesystem::path path = findFile(r.folder, name, r.parameters.where);
    Mesh mesh;
    try {
        mesh = readPly(path, r.import.memory());
    } catch (const Error& error) {
        throw Error(r.parameters.where, "{}", error.what());
    }
    mesh.colors.clear();
    if (r.parameters.find("displacement")) r.import.notes().add("bump and displacement maps are left out", name);
    r.parameters.ignore({"edgelength"});
    return mesh;
}

Mesh loopMesh(const Reader& r) {
    const Parameters& p = r.parameters;
    p.ignore({"scheme"});
    const uint32_t levels = p.count("levels", 3, 12);
    try {
        return loopSubdivided(controlMesh(p), levels, r.import.memory());
    } catch (const Error& error) {
        throw Error(p.where, "{}", error.what());
    }
}

/// Four corners (u, v) = (0, 0), (1, 0), (0, 1), (1, 1) with one attribute.
template <typename Value>
Value bilinear(const std::vector<Value>& values, const uint32_t* corners, float u, float v) {
    return (1 - v) * ((1 - u) * values[corners[0]] + u * values[corners[1]]) +
           v * ((1 - u) * values[corners[2]] + u * values[corners[3]]);
}

bool isParallelogram(const std::vector<glm::vec3>& p, const uint32_t* c) {
    const glm::vec3 twist = p[c[0]] - p[c[1]] - p[c[2]] + p[c[3]];
    return glm::length(twist) <= 1e-5f * (glm::length(p[c[1]] - p[c[0]]) + glm::length(p[c[2]] - p[c[0]]));
}

Mesh bilinearMesh(const Reader& r) {
    constexpr uint32_t kEdges = 16;  ///< Of a patch that is no parallelogram, along each side.
    const Parameters& p = r.parameters;
    Mesh control;
    control.positions = p.points3("P");
    control.normals = p.points3("N");
    control.texCoords0 = p.points2("uv");
    checkCount(p, "N", control.normals.size(), control);
    checkCount(p, "uv", control.texCoords0.size(), control);
    if (p.find("emissionfilename")) r.import.notes().add("'emissionfilename' of patches is left out", p.place());
    p.ignore({"faceIndices"});
    const std::vector<uint32_t> indices = indicesOf(p, control.positions.size(), 4);
    Mesh mesh;
    for (size_t i = 0; i + 3 < indices.size(); i += 4) {
        const uint32_t* corners = indices.data() + i;
        const uint32_t edges = isParallelogram(control.positions, corners) ? 1 : kEdges;
        r.import.memory().reserve(2 * edges * edges, sizeof(glm::uvec3) + 2 * sizeof(glm::vec4));
        const uint32_t first = uint32_t(mesh.positions.size());
        for (uint32_t y = 0; y <= edges; ++y)
            for (uint32_t x = 0; x <= edges; ++x) {
                const float u = float(x) / float(edges), v = float(y) / float(edges);
                mesh.positions.push_back(bilinear(control.positions, corners, u, v));
                if (!control.normals.empty()) mesh.normals.push_back(bilinear(control.normals, corners, u, v));
                mesh.texCoords0.push_back(control.texCoords0.empty() ? glm::vec2(u, v)
                                                                     : bilinear(control.texCoords0, corners, u, v));
            }
        for (uint32_t y = 0; y < edges; ++y)
            for (uint32_t x = 0; x < edges; ++x) {
                const uint32_t a = first + y * (edges + 1) + x, b = a + edges + 1;
                mesh.triangles.push_back({a, a + 1, b + 1});
                mesh.triangles.push_back({a, b + 1, b});
            }
    }
    return mesh;
}

double positive(const Parameters& p, const char* name, double otherwise) {
    const double value = p.number(name, otherwise);
    if (!(value > 0 && value <= 1e30)) p.fail("'{}' is {}; it is above 0", name, value);
    return value;
}

Turn turnOf(const Parameters& p) {
    const double degrees = p.number("phimax", 360);
    if (!(degrees > 0)) p.fail("'phimax' is {}; it is above 0 and at most 360 degrees", degrees);
    return {glm::radians(std::min(degrees, 360.0))};
}

Mesh sphere(const Reader& r) {
    const Parameters& p = r.parameters;
    const double radius = positive(p, "radius", 1);
    const double z0 = std::clamp(p.number("zmin", -radius), -radius, radius);
    const double z1 = std::clamp(p.number("zmax", radius), -radius, radius);
    // pbrt takes either order
    const double top = std::acos(std::max(z0, z1) / radius), bottom = std::acos(std::min(z0, z1) / radius);
    if (!(bottom > top)) p.fail("'zmin' and 'zmax' leave nothing of the sphere");
    Mesh mesh = sphereShape(radius, turnOf(p), top, bottom);
    // pbrt's v is 0 at the bottom and 1 at the top
    for (glm::vec2& uv : mesh.texCoords0) uv.y = float((bottom - pi * double(uv.y)) / (bottom - top));
    return mesh;
}

Mesh disk(const Reader& r) {
    const Parameters& p = r.parameters;
    const double radius = positive(p, "radius", 1), inner = p.number("innerradius", 0);
    if (!(inner >= 0 && inner < radius)) p.fail("'innerradius' is {}; it is below 'radius'", inner);
    Mesh mesh = diskShape(p.number("height", 0), inner, radius, turnOf(p));
    // pbrt's v is 1 inside
    for (glm::vec2& uv : mesh.texCoords0) uv.y = 1 - uv.y;
    return mesh;
}

Mesh cylinder(const Reader& r) {
    const Parameters& p = r.parameters;
    const double radius = positive(p, "radius", 1), a = p.number("zmin", -1), b = p.number("zmax", 1);
    if (a == b) p.fail("'zmin' and 'zmax' leave nothing of the cylinder");
    return cylinderShape(radius, std::min(a, b), std::max(a, b), turnOf(p));
}

Mesh curve(const Reader& r) {
    r.import.notes().add("curves, such as hair, are left out", r.parameters.place());
    r.parameters.ignore({"P", "N", "type", "basis", "degree", "width", "width0", "width1", "splitdepth"});
    return {};
}

/// Gives each triangle its own vertices, with pbrt's default (u, v).
void addTexCoords(Mesh& mesh, MemoryBudget& memory) {
    memory.reserve(3 * mesh.triangles.size(), 2 * sizeof(glm::vec3) + sizeof(glm::vec2));
    Mesh apart;
    for (glm::uvec3& t : mesh.triangles) {
        const uint32_t first = uint32_t(apart.positions.size());
        for (int c = 0; c < 3; ++c) {
            apart.positions.push_back(mesh.positions[t[c]]);
            if (!mesh.normals.empty()) apart.normals.push_back(mesh.normals[t[c]]);
            apart.texCoords0.emplace_back(c > 0 ? 1 : 0, c > 1 ? 1 : 0);
        }
        t = {first, first + 1, first + 2};
    }
    apart.triangles = std::move(mesh.triangles);
    mesh = std::move(apart);
}

const std::map<std::string, Mesh (*)(const Reader&)>& readers() {
    static const std::map<std::string, Mesh (*)(const Reader&)> table{
        {"bilinearmesh", bilinearMesh}, {"curve", curve},     {"cylinder", cylinder}, {"disk", disk},
        {"loopsubdiv", loopMesh},       {"plymesh", plyMesh}, {"sphere", sphere},     {"trianglemesh", triangleMesh},
    };
    return table;
}

}  // namespace

Mesh meshOf(const Shape& shape, bool isTextured, const std::filesystem::path& folder, SceneImport& import) {
    const Parameters& p = *shape.parameters;
    const auto reader = readers().find(p.kind);
    if (reader == readers().end()) {
        std::vector<std::string> kinds;
        for (const auto& entry : readers()) kinds.push_back(entry.first);
        p.fail("the shape \"{}\" is unknown{}", p.kind.substr(0, 40), didYouMean(p.kind, kinds));
    }
    Mesh mesh = reader->second({p, folder, import});
    if (isTextured && mesh.texCoords0.empty()) addTexCoords(mesh, import.memory());
    mesh.name = p.kind == "plymesh" ? std::filesystem::path(p.text("filename", "")).filename().string()
                                    : p.kind + " " + p.place();
    frontsTowardsNormals(mesh);
    // The normals of pbrt's subdivision surfaces are on the other side, which decides where they shine
    const bool isInverted = p.kind == "loopsubdiv" && shape.areaLight;
    if (shape.isReversed != isInverted) reverseFronts(mesh);
    return mesh;
}

}  // namespace voxray::pbrt
