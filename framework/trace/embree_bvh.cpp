#include "trace/embree_bvh.h"

#include <algorithm>

#include "base/error.h"
#include "base/interrupt.h"
#include "trace/texture_lookup.h"

namespace voxray {

namespace {

/// Embree's callback for hits on alpha-masked triangles: drops those that are cut away.
void dropCutAway(const RTCFilterFunctionNArguments* args) {
    const auto& group = *static_cast<const EmbreeBvh::TriangleGroup*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const uint32_t triangle = group.ids[RTCHitN_primID(args->hit, args->N, i)];
        if (isCutAway(*group.state, triangle, RTCHitN_u(args->hit, args->N, i),
                      RTCHitN_v(args->hit, args->N, i)))
            args->valid[i] = 0;
    }
}

void throwEmbreeError(const char* reason) {
    throw Error("Embree can't build the scene: {}", reason);
}

}  // namespace

EmbreeBvh::~EmbreeBvh() {
    for (const Part* part : {&still, &moving})
        if (part->scene) rtcReleaseScene(part->scene);
    if (device) rtcReleaseDevice(device);
}

void EmbreeBvh::build(const SceneState& state, RTCBuildQuality ofStill, RTCBuildQuality ofMoving) {
    device = rtcNewDevice(nullptr);
    if (!device) throwEmbreeError("no device");
    rtcSetDeviceMemoryMonitorFunction(
        device,
        [](void* bvh, ssize_t change, bool) {
            static_cast<EmbreeBvh*>(bvh)->bytes += change;
            return true;
        },
        this);
    sort(state);
    buildPart(still, ofStill);
    if (!moving.moving.empty()) buildPart(moving, ofMoving);
}

void EmbreeBvh::update() {
    if (!moving.scene) return;
    fill(moving, moving.opaque, 0);
    fill(moving, moving.masked, 1);
    commit(moving);
}

void EmbreeBvh::sort(const SceneState& state) {
    const Geometry& geometry = state.geometry;
    for (Part* part : {&still, &moving}) part->opaque.state = part->masked.state = &state;
    const auto add = [&](Part& part, uint32_t triangle) -> TriangleGroup& {
        const Material& material = state.scene->materials[geometry.triangleMaterials[triangle]];
        TriangleGroup& group = material.alphaMode == AlphaMode::Mask ? part.masked : part.opaque;
        group.ids.push_back(triangle);
        return group;
    };
    uint32_t next = 0, vertices = 0;
    moving.moving = movingRuns(geometry);
    for (const InstanceRange& range : moving.moving) {
        for (; next < range.firstTriangle; ++next) add(still, next);
        for (; next < range.firstTriangle + range.triangleCount; ++next)
            add(moving, next).skipped.push_back(range.firstVertex - vertices);
        vertices += range.vertexCount;
    }
    for (; next < geometry.triangles.size(); ++next) add(still, next);
    still.sameNumbers = still.opaque.ids.size() == geometry.triangles.size();
}

void EmbreeBvh::attach(const Part& part, TriangleGroup& group, unsigned geomId, RTCBuildQuality quality) {
    if (group.ids.empty()) return;
    size_t vertices = part.moving.empty() ? group.state->geometry.positions.size() : 0;
    for (const InstanceRange& range : part.moving) vertices += range.vertexCount;
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);

    // Embree reads 16 bytes at each vertex: its own buffers have the padding that a std::vector lacks.
    if (!rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                 vertices) ||
        !rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                 group.ids.size())) {
        rtcReleaseGeometry(mesh);
        throwEmbreeError("out of memory");
    }

    // Alpha masks hold for every kind of ray.
    if (geomId == 1) {
        rtcSetGeometryUserData(mesh, &group);
        rtcSetGeometryIntersectFilterFunction(mesh, dropCutAway);
        rtcSetGeometryOccludedFilterFunction(mesh, dropCutAway);
    }
    rtcSetGeometryBuildQuality(mesh, quality);
    rtcAttachGeometryByID(part.scene, mesh, geomId);
    rtcReleaseGeometry(mesh);
    fill(part, group, geomId);
}

void EmbreeBvh::fill(const Part& part, const TriangleGroup& group, unsigned geomId) {
    if (group.ids.empty()) return;
    const Geometry& geometry = group.state->geometry;
    RTCGeometry mesh = rtcGetGeometry(part.scene, geomId);
    auto* positions = static_cast<glm::vec3*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_VERTEX, 0));
    auto* corners = static_cast<glm::uvec3*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_INDEX, 0));
    if (part.moving.empty()) std::copy(geometry.positions.begin(), geometry.positions.end(), positions);
    for (const InstanceRange& range : part.moving)
        positions = std::copy_n(geometry.positions.begin() + range.firstVertex, range.vertexCount, positions);
    for (size_t i = 0; i < group.ids.size(); ++i)
        corners[i] = geometry.triangles[group.ids[i]] - (group.skipped.empty() ? 0 : group.skipped[i]);
    rtcUpdateGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcUpdateGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0);
    rtcCommitGeometry(mesh);
}

void EmbreeBvh::buildPart(Part& part, RTCBuildQuality quality) {
    part.scene = rtcNewScene(device);
    rtcSetSceneFlags(part.scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(part.scene, quality);
    rtcSetSceneProgressMonitorFunction(
        part.scene, [](void*, double) { return !interruptRequested(); }, nullptr);
    attach(part, part.opaque, 0, quality);
    attach(part, part.masked, 1, quality);
    commit(part);
}

void EmbreeBvh::commit(const Part& part) {
    rtcCommitScene(part.scene);
    switch (rtcGetDeviceError(device)) {
        case RTC_ERROR_NONE:
            break;
        case RTC_ERROR_CANCELLED:
            throw Interrupted();
        case RTC_ERROR_OUT_OF_MEMORY:
            throwEmbreeError("out of memory");
            break;
        case RTC_ERROR_UNSUPPORTED_CPU:
            throwEmbreeError("this processor lacks SSE2");
            break;
        default:
            throwEmbreeError("the triangles were refused");
    }
}

}  // namespace voxray
