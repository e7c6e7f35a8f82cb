#include "trace/embree_bvh.h"

#include <algorithm>

#include "base/error.h"
#include "base/interrupt.h"
#include "trace/texture_lookup.h"

namespace voxray {

namespace {

/// Embree's filter function for alpha-masked triangles: rejects hits below the cutoff.
void rejectAlphaCut(const RTCFilterFunctionNArguments* args) {
    const auto& group = *static_cast<const EmbreeBvh::TriangleGroup*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const uint32_t triangle = group.ids[RTCHitN_primID(args->hit, args->N, i)];
        if (isCutAway(*group.state, triangle, RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i)))
            args->valid[i] = 0;
    }
}

void throwEmbreeError(const char* reason) {
    throw Error("Embree can't build the scene: {}", reason);
}

}  // namespace

EmbreeBvh::~EmbreeBvh() {
    for (const Bvh* bvh : {&staticBvh, &dynamicBvh})
        if (bvh->scene) rtcReleaseScene(bvh->scene);
    if (device) rtcReleaseDevice(device);
}

void EmbreeBvh::build(const SceneState& state, RTCBuildQuality staticQuality, RTCBuildQuality dynamicQuality) {
    device = rtcNewDevice(nullptr);
    if (!device) throwEmbreeError("no device");
    rtcSetDeviceMemoryMonitorFunction(
        device,
        [](void* self, ssize_t change, bool) {
            static_cast<EmbreeBvh*>(self)->bytes += change;
            return true;
        },
        this);
    sort(state);
    buildBvh(staticBvh, staticQuality);
    if (!dynamicBvh.instances.empty()) buildBvh(dynamicBvh, dynamicQuality);
}

void EmbreeBvh::update() {
    if (!dynamicBvh.scene) return;
    fill(dynamicBvh, dynamicBvh.opaque, 0);
    fill(dynamicBvh, dynamicBvh.masked, 1);
    commit(dynamicBvh);
}

void EmbreeBvh::sort(const SceneState& state) {
    const Geometry& geometry = state.geometry;
    for (Bvh* bvh : {&staticBvh, &dynamicBvh}) bvh->opaque.state = bvh->masked.state = &state;
    const auto add = [&](Bvh& bvh, uint32_t triangle) -> TriangleGroup& {
        const Material& material = state.scene->materials[geometry.triangleMaterials[triangle]];
        TriangleGroup& group = material.alphaMode == AlphaMode::Mask ? bvh.masked : bvh.opaque;
        group.ids.push_back(triangle);
        return group;
    };
    uint32_t next = 0, vertices = 0;
    dynamicBvh.instances = movingInstanceRanges(geometry);
    for (const InstanceRange& range : dynamicBvh.instances) {
        for (; next < range.firstTriangle; ++next) add(staticBvh, next);
        for (; next < range.firstTriangle + range.triangleCount; ++next)
            add(dynamicBvh, next).vertexOffsets.push_back(range.firstVertex - vertices);
        vertices += range.vertexCount;
    }
    for (; next < geometry.triangles.size(); ++next) add(staticBvh, next);
    staticBvh.idsAreIdentity = staticBvh.opaque.ids.size() == geometry.triangles.size();
}

void EmbreeBvh::attach(const Bvh& bvh, TriangleGroup& group, unsigned geomId, RTCBuildQuality quality) {
    if (group.ids.empty()) return;
    size_t vertices = bvh.instances.empty() ? group.state->geometry.positions.size() : 0;
    for (const InstanceRange& range : bvh.instances) vertices += range.vertexCount;
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);

    // Embree reads 16 bytes per vertex: its own buffers are padded for that.
    if (!rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), vertices) ||
        !rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                 group.ids.size())) {
        rtcReleaseGeometry(mesh);
        throwEmbreeError("out of memory");
    }

    if (geomId == 1) {
        rtcSetGeometryUserData(mesh, &group);
        rtcSetGeometryIntersectFilterFunction(mesh, rejectAlphaCut);
        rtcSetGeometryOccludedFilterFunction(mesh, rejectAlphaCut);
    }
    rtcSetGeometryBuildQuality(mesh, quality);
    rtcAttachGeometryByID(bvh.scene, mesh, geomId);
    rtcReleaseGeometry(mesh);
    fill(bvh, group, geomId);
}

void EmbreeBvh::fill(const Bvh& bvh, const TriangleGroup& group, unsigned geomId) {
    if (group.ids.empty()) return;
    const Geometry& geometry = group.state->geometry;
    RTCGeometry mesh = rtcGetGeometry(bvh.scene, geomId);
    auto* positions = static_cast<glm::vec3*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_VERTEX, 0));
    auto* indices = static_cast<glm::uvec3*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_INDEX, 0));
    if (bvh.instances.empty()) std::copy(geometry.positions.begin(), geometry.positions.end(), positions);
    for (const InstanceRange& range : bvh.instances)
        positions = std::copy_n(geometry.positions.begin() + range.firstVertex, range.vertexCount, positions);
    for (size_t i = 0; i < group.ids.size(); ++i)
        indices[i] = geometry.triangles[group.ids[i]] - (group.vertexOffsets.empty() ? 0 : group.vertexOffsets[i]);
    rtcUpdateGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcUpdateGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0);
    rtcCommitGeometry(mesh);
}

void EmbreeBvh::buildBvh(Bvh& bvh, RTCBuildQuality quality) {
    bvh.scene = rtcNewScene(device);
    rtcSetSceneFlags(bvh.scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(bvh.scene, quality);
    rtcSetSceneProgressMonitorFunction(
        bvh.scene, [](void*, double) { return !interruptRequested(); }, nullptr);
    attach(bvh, bvh.opaque, 0, quality);
    attach(bvh, bvh.masked, 1, quality);
    commit(bvh);
}

void EmbreeBvh::commit(const Bvh& bvh) {
    rtcCommitScene(bvh.scene);
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
