#include <glm/geometric.hpp>
#include <map>

#include "base/interrupt.h"
#include "scene/load.h"
#include "scene/pbrt/camera.h"
#include "scene/pbrt/lights.h"
#include "scene/pbrt/materials.h"
#include "scene/pbrt/parser.h"
#include "scene/pbrt/shapes.h"

namespace voxray {
namespace pbrt {
namespace {

/// Of a mesh in the world.
double areaOf(const Mesh& mesh, const glm::dmat4& toWorld) {
    const auto p = [&](uint32_t i) { return glm::dvec3(toWorld * glm::dvec4(glm::dvec3(mesh.positions[i]), 1)); };
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) area += glm::length(glm::cross(p(t.y) - p(t.x), p(t.z) - p(t.x))) / 2;
    return area;
}

/// Makes a scene of a description.
class Builder {
 public:
    Builder(const std::filesystem::path& path, SceneImport& import)
        : import_(import),
          description_(parse(path, import.notes(), import.memory())),
          textures_(description_, path.parent_path(), import),
          materials_(description_, textures_, import),
          lights_(textures_, import) {}

    void build() {
        if (showsMirrored(description_)) import_.mirror();
        addCamera(description_, import_);
        for (const Shape& shape : description_.shapes)
            if (const auto mesh = addShape(shape)) import_.place(*mesh, shape.toWorld, nameOf(*mesh));
        addInstances();
        for (const Light& light : description_.lights) lights_.add(light);
        noteUnused();
    }

 private:
    struct ObjectMesh {
        uint32_t mesh;
        glm::dmat4 toObject;
    };

    const std::string& nameOf(uint32_t mesh) { return import_.scene().meshes[mesh].name; }

    std::optional<uint32_t> addShape(const Shape& shape) {
        if (interruptRequested()) throw Interrupted();
        Surface surface = materials_.surface(shape.material);
        const std::string name = Materials::nameOf(shape.material);
        if (surface.isNothing) {
            if (shape.areaLight)
                import_.notes().add("surfaces of an interface between media do not shine, as in pbrt",
                                    shape.parameters->place());
            for (const auto* parameter : shape.parameters->unused()) parameter->isUsed = true;
            return {};
        }
        const bool isLeft = cutHoles(shape, surface);
        const bool isTextured = surface.color.image || surface.roughness.image || surface.opacity.image ||
                                surface.normalMap || (shape.areaLight && shape.areaLight->find("filename"));
        Mesh mesh = meshOf(shape, isTextured, textures_.folder(), import_);
        if (!isLeft) return {};
        mesh.material = materialOf(shape, surface, name, areaOf(mesh, shape.toWorld));
        try {
            return import_.addMesh(std::move(mesh));
        } catch (const Error& error) {
            throw Error(shape.parameters->where, "{}", error.what());
        }
    }

    /// Applies a shape's 'alpha'. @return whether anything of it is left
    bool cutHoles(const Shape& shape, Surface& surface) {
        if (!shape.parameters->find("alpha")) return true;
        surface.opacity = textures_.number(*shape.parameters, "alpha", 1);
        if (surface.opacity.image) return true;
        const float alpha = surface.opacity.value.x;
        if (alpha >= 0.5f || shape.areaLight) {
            surface.opacity = glm::vec3(1);
            if (alpha < 1)
                import_.notes().add("surfaces with an alpha of at least 0.5, or that shine, are opaque",
                                    shape.parameters->place());
            return true;
        }
        if (alpha > 0) import_.notes().add("surfaces with an alpha below 0.5 are left out", shape.parameters->place());
        return false;
    }

    /// The scene's material for a surface with the shape's light; equal ones are stored once.
    uint32_t materialOf(const Shape& shape, const Surface& surface, const std::string& name, double area) {
        const Parameter* alpha = shape.parameters->find("alpha");
        const bool isOfArea = shape.areaLight && shape.areaLight->find("power");
        const auto key = std::tuple(shape.material.material.get(), shape.material.name, shape.areaLight.get(),
                                    alpha && !alpha->strings.empty() ? alpha->strings[0] : "", isOfArea ? area : 0.0);
        const auto known = stored_.find(key);
        if (known != stored_.end()) return known->second;
        import_.memory().reserve(1, sizeof(Material) + 256);
        const SurfaceEmission emission = shape.areaLight ? lights_.emission(*shape.areaLight, area) : SurfaceEmission();
        return stored_[key] = storeSurface(surface, emission, name, import_.scene(), import_.images(), import_.notes());
    }

    void addInstances() {
        std::map<std::string, std::vector<ObjectMesh>> objects;
        for (const Instance& instance : description_.instances) {
            const auto object = description_.objects.find(instance.object);
            if (object == description_.objects.end())
                throw Error(instance.where, "no ObjectBegin defines \"{}\"", instance.object.substr(0, 100));
            const auto [meshes, isNew] = objects.try_emplace(instance.object);
            if (isNew)
                for (const Shape& shape : object->second)
                    if (const auto mesh = addShape(shape)) meshes->second.push_back({*mesh, shape.toWorld});
            for (const ObjectMesh& part : meshes->second) {
                if (interruptRequested()) throw Interrupted();
                // Instances become triangles of their own in the world
                const Mesh& mesh = import_.scene().meshes[part.mesh];
                import_.memory().reserve(mesh.positions.size() + mesh.triangles.size(), sizeof(glm::vec4));
                import_.place(part.mesh, instance.toWorld * part.toObject, nameOf(part.mesh));
            }
        }
    }

    void noteUnused() {
        const auto note = [&](const ParametersPtr& parameters) {
            for (const Parameter* parameter : parameters->unused())
                import_.notes().add(
                    fmt::format("parameter '{}' of {} is left out", parameter->name, parameters->directive),
                    shortPlace(parameter->where));
        };
        if (description_.camera) note(description_.camera->parameters);
        if (description_.film) note(description_.film);
        const auto noteIfMade = [&](const ParametersPtr& parameters) {
            if (parameters->isTouched()) note(parameters);
        };
        for (const auto& entry : description_.materials) noteIfMade(entry.second);
        for (const auto* textures : {&description_.floatTextures, &description_.colorTextures})
            for (const auto& entry : *textures) noteIfMade(entry.second.parameters);
        for (const Light& light : description_.lights) note(light.parameters);
        for (const Shape& shape : description_.shapes) {
            note(shape.parameters);
            if (shape.material.material) note(shape.material.material);
            if (shape.areaLight) note(shape.areaLight);
        }
        for (const Instance& instance : description_.instances)
            for (const Shape& shape : description_.objects.at(instance.object)) {
                note(shape.parameters);
                if (shape.material.material) note(shape.material.material);
            }
    }

    SceneImport& import_;
    Description description_;
    Textures textures_;
    Materials materials_;
    Lights lights_;
    std::map<std::tuple<const Parameters*, std::string, const Parameters*, std::string, double>, uint32_t> stored_;
};

}  // namespace
}  // namespace pbrt

std::shared_ptr<const Scene> loadPbrt(const std::filesystem::path& path) {
    SceneImport import(path);
    try {
        pbrt::Builder(path, import).build();
    } catch (const Error& error) {
        // Faults that no directive is named for, as too little memory
        const std::string message = error.what();
        const std::string folder = path.parent_path().string();
        if (message.starts_with(path.string()) || (!folder.empty() && message.starts_with(folder))) throw;
        throw Error("{}: {}", path.string(), message);
    }
    return import.finish();
}

}  // namespace voxray
