#include "scene/mitsuba/shapes.h"

#include <glm/gtc/matrix_transform.hpp>

#include "base/interrupt.h"
#include "scene/import/mesh_normals.h"
#include "scene/import/obj.h"
#include "scene/import/ply.h"
#include "scene/import/shapes.h"
#include "scene/mitsuba/serialized.h"

namespace voxray::mitsuba {
namespace {

/// From the unit cylinder along +Z to one from p0 to p1, without its radius. The angle begins where Mitsuba's does.
/// Source: Duff et al., Building an Orthonormal Basis, Revisited (JCGT 2017).
glm::dmat4 alongAxis(const glm::dvec3& p0, const glm::dvec3& p1, const TextLocation& where) {
    const glm::dvec3 axis = p1 - p0;
    const double length = glm::length(axis);
    if (!(length > 0)) throw Error(where, "a cylinder's p0 and p1 differ");
    const glm::dvec3 z = axis / length;
    const double sign = std::copysign(1.0, z.z), a = -1 / (sign + z.z);
    const glm::dvec3 x(1 + sign * z.x * z.x * a, sign * z.x * z.y * a, -sign * z.x);
    return glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(axis, 0), glm::dvec4(p0, 1));
}

void flipV(Mesh& mesh) {
    for (glm::vec2& uv : mesh.texCoords0) uv.y = 1 - uv.y;
}

}  // namespace

void Shapes::add(const Plugin& shape) {
    if (shape.type == "shapegroup") return;
    for (const Part& part : partsOf(shape, false)) import_.place(part.mesh, part.toWorld, part.name);
}

Shapes::Parts Shapes::partsOf(const Plugin& shape, bool isInGroup) {
    if (interruptRequested()) throw Interrupted();
    if (!shape.childrenOf("medium").empty() || !shape.childrenOf("subsurface").empty())
        import_.notes().add("media and subsurface scattering are left out", shape.name());
    if (shape.type == "instance" && !isInGroup) return instance(shape);
    if (shape.type == "merge" && !isInGroup) {
        Parts parts;
        for (const Plugin* inner : shape.childrenOf("shape"))
            for (Part& part : partsOf(*inner, true)) parts.push_back(std::move(part));
        return parts;
    }
    glm::dmat4 toWorld = shape.transform("to_world");
    std::optional<Mesh> mesh = meshOf(shape, toWorld);
    if (!mesh) return {};
    import_.memory().reserve(mesh->positions.size(), 2 * sizeof(glm::vec3) + sizeof(glm::vec2));
    bool usesVertexColors = false;
    const std::optional<uint32_t> material = materialOf(shape, usesVertexColors);
    if (!material) return {};
    if (!usesVertexColors) mesh->colors.clear();
    mesh->material = *material;
    if (shape.flag("flip_normals", false)) reverseFronts(*mesh);
    const std::string name = shape.id.empty() ? fmt::format("{} {}", shape.type, shape.where.line) : shape.id;
    if (mesh->name.empty()) mesh->name = name;
    const std::optional<uint32_t> number = import_.addMesh(std::move(*mesh));
    if (!number) return {};
    return {{*number, toWorld, name}};
}

Shapes::Parts Shapes::instance(const Plugin& shape) {
    const std::vector<const Plugin*> of = shape.childrenOf("shape");
    if (of.size() != 1 || of[0]->type != "shapegroup")
        throw Error(shape.where, "an instance names one shapegroup: <ref id=\"…\"/>");
    Parts parts = group(*of[0]);
    for (Part& part : parts) part.toWorld = shape.transform("to_world") * part.toWorld;
    return parts;
}

const Shapes::Parts& Shapes::group(const Plugin& shape) {
    const auto [entry, isNew] = groups_.try_emplace(&shape);
    if (!isNew) return entry->second;
    for (const Plugin* inner : shape.childrenOf("shape"))
        for (Part& part : partsOf(*inner, true)) entry->second.push_back(std::move(part));
    return entry->second;
}

std::optional<Mesh> Shapes::meshOf(const Plugin& shape, glm::dmat4& toWorld) {
    const std::string& type = shape.type;
    const bool isMirrored = glm::determinant(glm::dmat3(toWorld)) < 0;
    if (type == "sphere" || type == "disk" || type == "cylinder")
        import_.notes().add(fmt::format("'{}' shapes become meshes of equal area with 64 edges around", type),
                            shape.name());
    if (type == "obj" || type == "ply" || type == "serialized") return meshFile(shape, isMirrored);
    if (type == "rectangle") return rectangleShape();
    if (type == "cube") return cubeShape();
    if (type == "sphere") {
        toWorld = glm::translate(toWorld, shape.vector("center", glm::dvec3(0)));
        return sphereShape(shape.number("radius", 1));
    }
    if (type == "disk") {
        // Mitsuba's texture coordinates: radius, angle
        Mesh disk = diskShape(0, 0, 1);
        for (glm::vec2& uv : disk.texCoords0) std::swap(uv.x, uv.y);
        return disk;
    }
    if (type == "cylinder") {
        toWorld = toWorld * alongAxis(shape.vector("p0", {0, 0, 0}), shape.vector("p1", {0, 0, 1}), shape.where);
        return cylinderShape(shape.number("radius", 1), 0, 1);
    }
    import_.notes().add(fmt::format("'{}' shapes are left out", type), shape.name());
    return {};
}

std::optional<Mesh> Shapes::meshFile(const Plugin& shape, bool isMirrored) {
    const std::string file = shape.text("filename", "");
    if (file.empty()) throw Error(shape.where, "{} has no filename", shape.what());
    const std::filesystem::path path = document_.resolve(file);
    const bool isObj = shape.type == "obj";
    Mesh mesh;
    if (shape.type == "serialized") {
        const double index = shape.number("shape_index", 0);
        if (!(index >= 0 && index < 4294967296.0)) throw Error(shape.where, "shape_index: expected 0 or more");
        mesh = readSerialized(path, uint64_t(index), import_.memory());
    } else {
        mesh = isObj ? readObj(path, import_.memory()) : readPly(path, import_.memory());
    }
    if (shape.flag("flip_tex_coords", isObj)) flipV(mesh);
    for (const glm::uvec3& t : mesh.triangles)
        if (std::max({t.x, t.y, t.z}) >= mesh.positions.size())
            throw Error("{}: a triangle has vertex {}, and there are {}", path.string(), std::max({t.x, t.y, t.z}),
                        mesh.positions.size());
    if (shape.number("max_smooth_angle", 0) > 0) import_.notes().add("'max_smooth_angle' has no effect", shape.name());
    const bool isFlat = shape.flag("face_normals", false);
    const bool hasNormals = mesh.normals.size() == mesh.positions.size() && !mesh.normals.empty();
    if (isFlat || !hasNormals) {
        mesh.normals.clear();
        // Mitsuba takes the order of the vertices in the world, which mirroring turns
        if (isMirrored) reverseFronts(mesh);
        if (!isFlat) makeSmoothNormals(mesh);
    }
    // A light's front is on the side of its vertices' normals
    frontsTowardsNormals(mesh);
    return mesh;
}

SurfaceEmission Shapes::emissionOf(const Plugin& shape) {
    SurfaceEmission emission;
    for (const Plugin* emitter : shape.childrenOf("emitter")) {
        if (emitter->type == "area")
            emission.radiance = colors_.color(*emitter, "radiance", glm::vec3(1), Meaning::Emission);
        else
            import_.notes().add(fmt::format("'{}' emitters of shapes are left out", emitter->type), emitter->name());
    }
    return emission;
}

std::optional<uint32_t> Shapes::materialOf(const Plugin& shape, bool& usesVertexColors) {
    const std::vector<const Plugin*> bsdfs = shape.childrenOf("bsdf"), emitters = shape.childrenOf("emitter");
    if (bsdfs.size() > 1) import_.notes().add("shapes of several BSDFs have the first everywhere", shape.name());
    const Plugin* bsdf = bsdfs.empty() ? nullptr : bsdfs.front();
    const Plugin* emitter = emitters.empty() ? nullptr : emitters.front();
    const Surface surface = bsdf ? surfaces_.surface(*bsdf) : lambertSurface(glm::vec3(0.5f));
    usesVertexColors = surface.usesVertexColors;
    if (surface.isNothing && !emitter) return {};
    if (surface.isOneSided || !bsdf)
        import_.notes().add("materials without 'twosided' reflect on both sides", bsdf ? bsdf->name() : "default");
    const auto [known, isNew] = materials_.try_emplace({bsdf, emitter}, 0);
    if (isNew) {
        const std::string name = bsdf && !bsdf->id.empty() ? bsdf->id
                                 : bsdf                    ? fmt::format("{} {}", bsdf->type, bsdf->where.line)
                                                           : "default";
        // Without a surface of its own a light reflects nothing
        const Surface stored = surface.isNothing ? lambertSurface(glm::vec3(0)) : surface;
        known->second = storeSurface(stored, emissionOf(shape), emitter ? name + " light" : name, import_.scene(),
                                     import_.images(), import_.notes());
    }
    return known->second;
}

}  // namespace voxray::mitsuba
