#include "scene/geometry.h"

#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <span>

#include "base/error.h"
#include "base/parallel.h"
#include "scene/animation.h"
#include "scene/morph.h"
#include "scene/swept_bounds.h"

namespace voxray {
namespace {

constexpr uint64_t maxCount = uint64_t(1) << 31;
constexpr size_t grain = 16384;

/// The normalized vector, or the fallback for a zero vector.
glm::vec3 directionOr(const glm::vec3& v, const glm::vec3& fallback) {
    const glm::dvec3 d(v);
    const double length = glm::length(d);
    return length > 0 && std::isfinite(length) ? glm::vec3(d / length) : fallback;
}

/// Normal matrix: det(m) times the inverse transpose of m, which exists for singular m, too.
glm::mat3 cofactorMatrix(const glm::mat3& m) {
    return glm::mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
}

/// Counts vertices and triangles of all instances. @throws Error if they are too many.
Geometry allocate(const Scene& scene) {
    Geometry geometry;
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    geometry.instances.reserve(scene.instances.size());
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        geometry.instances.push_back({uint32_t(triangles), uint32_t(mesh.triangles.size()), uint32_t(vertices),
                                      uint32_t(mesh.positions.size())});
        vertices += mesh.positions.size();
        triangles += mesh.triangles.size();
        if (vertices > maxCount || triangles > maxCount)
            throw Error("{}: its instances have more than 2^31 vertices or triangles; use fewer instances", scene.name);
    }
    const uint64_t bytes =
        vertices * (sizeof(glm::vec3) + sizeof(VertexAttributes)) + triangles * (sizeof(glm::uvec3) + sizeof(uint32_t));
    const uint64_t memory = uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE));
    if (bytes > memory)
        throw Error("{}: {} vertices and {} triangles need {} MiB, this machine has {} MiB; use fewer instances",
                    scene.name, vertices, triangles, bytes >> 20, memory >> 20);
    geometry.positions.resize(vertices);
    geometry.attributes.resize(vertices);
    geometry.triangles.resize(triangles);
    geometry.triangleMaterials.resize(triangles);
    return geometry;
}

/// Transform of a vertex to world space.
struct VertexTransform {
    explicit VertexTransform(const glm::mat4& matrix)
        : world(matrix), linear(matrix), mirrored(glm::determinant(glm::dmat3(linear)) < 0) {
        normalMatrix = cofactorMatrix(linear) * (mirrored ? -1.0f : 1.0f);
    }
    glm::mat4 world;
    glm::mat3 linear, normalMatrix;
    bool mirrored;
};

/// World matrices of a skin's joints times their inverse bind matrices.
std::vector<glm::mat4> jointMatrices(const Skin& skin, const std::vector<glm::mat4>& world) {
    std::vector<glm::mat4> matrices;
    for (size_t i = 0; i < skin.joints.size(); ++i)
        matrices.push_back(world[skin.joints[i]] * skin.inverseBindMatrices[i]);
    return matrices;
}

/// Linear blend skinning (glTF 2.0, section 3.7.3.3).
glm::mat4 blended(const Mesh& mesh, const std::vector<glm::mat4>& joints, size_t vertex) {
    glm::mat4 sum(0.0f);
    for (const SkinWeights& set : mesh.skinWeights)
        for (int i = 0; i < 4; ++i)
            if (const float weight = set.weights[vertex][i]; weight > 0) sum += weight * joints[set.joints[vertex][i]];
    return sum;
}

/// A mesh's shape at rest or as its morph targets make it.
struct ShapeView {
    explicit ShapeView(const Mesh& mesh) : positions(mesh.positions), normals(mesh.normals), tangents(mesh.tangents) {}
    explicit ShapeView(const MorphedShape& shape)
        : positions(shape.positions), normals(shape.normals), tangents(shape.tangents) {}
    std::span<const glm::vec3> positions, normals;
    std::span<const glm::vec4> tangents;
};

/// @param transformOf gives a vertex's VertexTransform.
template <typename TransformOf>
void transformVertices(const Mesh& mesh, const ShapeView& shape, const InstanceRange& range,
                       const TransformOf& transformOf, Geometry& out) {
    parallelRanges(shape.positions.size(), grain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const VertexTransform& transform = transformOf(i);
            out.positions[range.firstVertex + i] = glm::vec3(transform.world * glm::vec4(shape.positions[i], 1.0f));
            VertexAttributes& a = out.attributes[range.firstVertex + i];
            if (!shape.normals.empty()) a.normal = directionOr(transform.normalMatrix * shape.normals[i], {0, 1, 0});
            if (!shape.tangents.empty()) {
                const glm::vec4 t = shape.tangents[i];
                a.tangent =
                    glm::vec4(directionOr(transform.linear * glm::vec3(t), {1, 0, 0}), transform.mirrored ? -t.w : t.w);
            }
            if (!mesh.texCoords0.empty()) {
                a.texCoords.x = mesh.texCoords0[i].x;
                a.texCoords.y = mesh.texCoords0[i].y;
            }
            if (!mesh.texCoords1.empty()) {
                a.texCoords.z = mesh.texCoords1[i].x;
                a.texCoords.w = mesh.texCoords1[i].y;
            }
            if (!mesh.colors.empty()) a.color = mesh.colors[i];
        }
    });

    // Mirroring flips the winding order: swap two vertices.
    parallelRanges(mesh.triangles.size(), grain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const bool mirrored = transformOf(mesh.triangles[i].x).mirrored;
            const glm::uvec3 t = mesh.triangles[i] + range.firstVertex;
            out.triangles[range.firstTriangle + i] = mirrored ? glm::uvec3(t.x, t.z, t.y) : t;
            out.triangleMaterials[range.firstTriangle + i] = mesh.material;
        }
    });
}

/// What animation decides of a scene at one time.
struct Pose {
    std::vector<glm::mat4> world;             ///< In the order of Scene::nodes.
    std::vector<std::vector<float>> weights;  ///< In the order of Scene::morphs.
};

Pose poseAt(const Scene& scene, double timeSeconds, Playback playback) {
    const double time = playback == Playback::Looping ? loopedTime(scene, timeSeconds) : timeSeconds;
    Pose pose{nodeToWorld(scene, time), {}};
    for (const MorphChannel& channel : scene.morphs) pose.weights.push_back(sampleWeights(channel, time));
    return pose;
}

/// Transforms an instance by its morph targets' weights, and then by its skin's joints or by its node.
void transformInstance(const Scene& scene, const Instance& instance, const Pose& pose, const InstanceRange& range,
                       Geometry& out) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const MorphedShape moved =
        instance.morph < 0 ? MorphedShape() : morphed(mesh, pose.weights[size_t(instance.morph)]);
    const ShapeView shape = instance.morph < 0 ? ShapeView(mesh) : ShapeView(moved);
    if (instance.skin >= 0) {
        const auto joints = jointMatrices(scene.skins[size_t(instance.skin)], pose.world);
        const auto transformOf = [&](size_t vertex) { return VertexTransform(blended(mesh, joints, vertex)); };
        transformVertices(mesh, shape, range, transformOf, out);
    } else {
        const VertexTransform transform(instance.node < 0 ? glm::mat4(1.0f) : pose.world[size_t(instance.node)]);
        transformVertices(
            mesh, shape, range, [&](size_t) -> const VertexTransform& { return transform; }, out);
    }
}

std::string nameOf(const Scene& scene, const Instance& instance) {
    const std::string node = instance.node < 0 ? "" : scene.nodes[size_t(instance.node)].name;
    return fmt::format("{}: mesh '{}'{}", scene.name, scene.meshes[instance.mesh].name,
                       node.empty() ? "" : " of node '" + node + "'");
}

/// @throws Error if a coordinate exceeds kMaxPosition or is NaN.
void checkCoordinates(const glm::vec3& p, const Scene& scene, const Instance& instance) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(p[axis]) <= kMaxPosition))
            throw Error(
                "{}: it has a vertex at ({:g}, {:g}, {:g}) m; coordinates go to {:g} m, "
                "for areas beyond are not finite: correct the vertex, or scale the scene down",
                nameOf(scene, instance), p.x, p.y, p.z, kMaxPosition);
}

/// Bounds of an instance's vertices. @throws Error as checkCoordinates()
Box boundsOf(const Geometry& geometry, const InstanceRange& range, const Scene& scene, const Instance& instance) {
    Box box = Box::empty();
    for (uint32_t i = range.firstVertex; i < range.firstVertex + range.vertexCount; ++i) {
        const glm::vec3& p = geometry.positions[i];
        checkCoordinates(p, scene, instance);
        box.include(p);
    }
    return box;
}

/// Bounds of all instances, for moving ones over all times.
void findBounds(const Scene& scene, Geometry& geometry) {
    if (geometry.positions.empty()) return;
    geometry.region = Box::empty();
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceRange& range = geometry.instances[i];
        Box box = boundsOf(geometry, range, scene, scene.instances[i]);
        if (range.moves) {
            box = sweptBounds(scene, scene.instances[i]);
            for (const glm::vec3& corner : {box.min, box.max}) checkCoordinates(corner, scene, scene.instances[i]);
        }
        geometry.region.include(box);
    }
    geometry.boundsMin = geometry.region.min;
    geometry.boundsMax = geometry.region.max;
}

/// A node's axis in world space. @throws Error if the node is scaled by 0.
glm::vec3 axisOf(const Scene& scene, const glm::mat4& world, const glm::vec3& axis, const std::string& what) {
    const glm::vec3 direction = directionOr(glm::mat3(world) * axis, glm::vec3(0.0f));
    if (direction == glm::vec3(0.0f))
        throw Error("{}: {} has no direction, because its node is scaled by 0; correct the scale", scene.name, what);
    return direction;
}

/// Transforms lights to world space; intensities don't change with scale.
std::vector<Light> placeLights(const Scene& scene, const std::vector<glm::mat4>& world) {
    std::vector<Light> lights = scene.lights;
    for (Light& light : lights) {
        if (light.node < 0) continue;
        const glm::mat4& toWorld = world[size_t(light.node)];
        light.position = glm::vec3(toWorld[3]);
        if (light.type != LightType::Point)
            light.direction = axisOf(scene, toWorld, {0, 0, -1}, "light '" + light.name + "'");
        light.node = -1;
    }
    return lights;
}

/// Transforms cameras to world space, with the up vector perpendicular to the view.
std::vector<Camera> placeCameras(const Scene& scene, const std::vector<glm::mat4>& world) {
    std::vector<Camera> cameras = scene.cameras;
    for (Camera& camera : cameras) {
        if (camera.node < 0) continue;
        const glm::mat4& toWorld = world[size_t(camera.node)];
        const std::string what = "camera '" + camera.name + "'";
        camera.position = glm::vec3(toWorld[3]);
        camera.forward = axisOf(scene, toWorld, {0, 0, -1}, what);
        const glm::vec3 up = axisOf(scene, toWorld, {0, 1, 0}, what);
        camera.up = directionOr(up - glm::dot(up, camera.forward) * camera.forward, {0, 0, 0});
        if (camera.up == glm::vec3(0.0f))
            throw Error("{}: {} has no up direction; correct its node's transform", scene.name, what);
        camera.node = -1;
    }
    return cameras;
}

}  // namespace

SceneState evaluate(std::shared_ptr<const Scene> scenePointer, double timeSeconds, Playback playback) {
    const Scene& scene = *scenePointer;
    const Pose pose = poseAt(scene, timeSeconds, playback);
    SceneState state;
    state.playback = playback;

    // Flatten the instances into world-space triangles.
    state.geometry = allocate(scene);
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        InstanceRange& range = state.geometry.instances[i];
        transformInstance(scene, instance, pose, range, state.geometry);
        range.moves = playback == Playback::Looping && range.vertexCount > 0 && movesInTime(scene, instance);
    }
    findBounds(scene, state.geometry);

    state.lights = placeLights(scene, pose.world);
    state.cameras = placeCameras(scene, pose.world);
    state.scene = std::move(scenePointer);
    return state;
}

double triangleArea(const Geometry& geometry, uint32_t triangle) {
    const glm::uvec3 v = geometry.triangles[triangle];
    const glm::dvec3 a = geometry.positions[v.x], b = geometry.positions[v.y], c = geometry.positions[v.z];
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

uint32_t instanceOf(const Geometry& geometry, uint32_t triangle) {
    const auto next = std::ranges::upper_bound(geometry.instances, triangle, {}, &InstanceRange::firstTriangle);
    return uint32_t(next - geometry.instances.begin()) - 1;
}

std::vector<InstanceRange> movingInstanceRanges(const Geometry& geometry) {
    std::vector<InstanceRange> runs;
    bool follows = false;
    for (const InstanceRange& range : geometry.instances) {
        if (range.moves && follows) {
            runs.back().triangleCount += range.triangleCount;
            runs.back().vertexCount += range.vertexCount;
        } else if (range.moves) {
            runs.push_back(range);
        }
        follows = range.moves;
    }
    return runs;
}

std::vector<Box> advance(SceneState& state, double timeSeconds) {
    const Scene& scene = *state.scene;
    const Pose pose = poseAt(scene, timeSeconds, state.playback);
    std::vector<Box> changed;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceRange& range = state.geometry.instances[i];
        if (!range.moves) continue;
        const Instance& instance = scene.instances[i];
        const Box before = boundsOf(state.geometry, range, scene, instance);
        transformInstance(scene, instance, pose, range, state.geometry);
        const Box after = boundsOf(state.geometry, range, scene, instance);
        changed.insert(changed.end(), {before, after});
    }
    state.lights = placeLights(scene, pose.world);
    state.cameras = placeCameras(scene, pose.world);
    if (state.panes) advance(*state.panes, timeSeconds);
    return changed;
}

}  // namespace voxray
