#include "trace/embree_scene.h"

#include <embree3/rtcore.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "trace/texture_lookup.h"

namespace voxray {

namespace {

/// Embree's own bound on coordinates (its FLT_LARGE): Debian's build aborts on rays beyond it.
constexpr float kLargest = 1.8e18f;
constexpr size_t kStreamGrain = 4096;

/// Triangles that share how they are intersected. Embree's primitive i is the scene's triangle ids[i].
struct TriangleGroup {
    std::vector<uint32_t> ids;
    const SceneState* state = nullptr;
};

bool isTraceable(float x) {
    return std::fabs(x) <= kLargest;
}

/// Without branches: it runs on every ray of a stream.
bool isTraceable(const Ray& ray) {
    return bool(int(isTraceable(ray.origin.x)) & int(isTraceable(ray.origin.y)) &
                int(isTraceable(ray.origin.z)) & int(isTraceable(ray.direction.x)) &
                int(isTraceable(ray.direction.y)) & int(isTraceable(ray.direction.z)) &
                int(ray.tMin >= 0.0f) & int(ray.tMin <= kLargest) & int(!std::isnan(ray.tMax)));
}

RTCRay toEmbree(const Ray& ray) {
    RTCRay out;
    std::memcpy(&out, &ray, 28);  // Origin, tMin and direction lie alike in both.
    out.time = 0.0f;
    out.tfar = ray.tMax;
    out.mask = 0xffffffffu;
    out.id = 0;
    out.flags = 0;
    return out;
}

/// Embree's callback for hits on alpha-masked triangles: drops those that are cut away.
void dropCutAway(const RTCFilterFunctionNArguments* args) {
    const auto& group = *static_cast<const TriangleGroup*>(args->geometryUserPtr);
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

struct EmbreeScene::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    TriangleGroup opaque, masked;
    bool oneGroup = true;  ///< Every triangle is opaque: Embree's numbers are ours.
    std::atomic<ptrdiff_t> bytes{0};

    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }

    /// Adds the group's triangles as geometry number `geomId`.
    void attach(TriangleGroup& group, const Geometry& geometry, unsigned geomId, bool filtered) {
        if (group.ids.empty()) return;
        RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);

        // Embree reads 16 bytes at each vertex: its own buffers have the padding that a std::vector lacks.
        auto* positions = static_cast<glm::vec3*>(
            rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                    geometry.positions.size()));
        auto* corners = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), group.ids.size()));
        if (!positions || !corners) {
            rtcReleaseGeometry(mesh);
            throwEmbreeError("out of memory");
        }
        std::memcpy(positions, geometry.positions.data(), geometry.positions.size() * sizeof(glm::vec3));
        for (size_t i = 0; i < group.ids.size(); ++i) corners[i] = geometry.triangles[group.ids[i]];

        // Alpha masks hold for every kind of ray.
        if (filtered) {
            rtcSetGeometryUserData(mesh, &group);
            rtcSetGeometryIntersectFilterFunction(mesh, dropCutAway);
            rtcSetGeometryOccludedFilterFunction(mesh, dropCutAway);
        }
        rtcSetGeometryBuildQuality(mesh, RTC_BUILD_QUALITY_HIGH);
        rtcCommitGeometry(mesh);
        rtcAttachGeometryByID(scene, mesh, geomId);
        rtcReleaseGeometry(mesh);
    }

    Hit intersect(const Ray& ray, RTCIntersectContext& context) const {
        Hit hit{ray.tMax, Hit::kMiss, 0.0f, 0.0f};
        if (!(ray.tMax >= ray.tMin)) return hit;
        RTCRayHit query;
        query.ray = toEmbree(ray);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
        const uint32_t id = query.hit.primID;
        const uint32_t triangle = oneGroup ? id : (query.hit.geomID == 0 ? opaque : masked).ids[id];
        return {query.ray.tfar, triangle, query.hit.u, query.hit.v};
    }

    bool isOccluded(const Ray& ray, RTCIntersectContext& context) const {
        if (!(ray.tMax >= ray.tMin)) return false;
        RTCRay query = toEmbree(ray);
        rtcOccluded1(scene, &context, &query);
        return query.tfar < 0.0f;
    }

    /// Calls trace(i) for every ray of a stream, in parallel, after its check.
    template <typename Trace>
    void forEachRay(std::span<const Ray> rays, const Trace& trace) const {
        std::atomic<size_t> firstBad{rays.size()};
        parallelRanges(rays.size(), kStreamGrain, [&](size_t begin, size_t end) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            for (size_t i = begin; i < end; ++i) {
                if (isTraceable(rays[i])) [[likely]] {
                    trace(i, context);
                } else {
                    size_t known = firstBad.load();
                    while (i < known && !firstBad.compare_exchange_weak(known, i)) {
                    }
                    return;
                }
            }
        });
        if (firstBad != rays.size())
            throw Error(
                "ray {} of a stream of {} is NaN, infinite, beyond {} m or has a negative tMin: "
                "mark unused rays with tMax < tMin",
                firstBad.load(), rays.size(), kLargest);
    }
};

EmbreeScene::EmbreeScene(const SceneState& state) : impl_(std::make_unique<Impl>()) {
    impl_->device = rtcNewDevice(nullptr);
    if (!impl_->device) throwEmbreeError("no device");
    rtcSetDeviceMemoryMonitorFunction(
        impl_->device,
        [](void* impl, ssize_t change, bool) {
            static_cast<Impl*>(impl)->bytes += change;
            return true;
        },
        impl_.get());

    // Sort the triangles into opaque and alpha-masked ones.
    const Geometry& geometry = state.geometry;
    impl_->opaque.state = impl_->masked.state = &state;
    for (uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const Material& material = state.scene->materials[geometry.triangleMaterials[i]];
        (material.alphaMode == AlphaMode::Mask ? impl_->masked : impl_->opaque).ids.push_back(i);
    }
    impl_->oneGroup = impl_->masked.ids.empty();

    // Build one BVH over both.
    impl_->scene = rtcNewScene(impl_->device);
    rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);
    impl_->attach(impl_->opaque, geometry, 0, false);
    impl_->attach(impl_->masked, geometry, 1, true);
    rtcCommitScene(impl_->scene);
    switch (rtcGetDeviceError(impl_->device)) {
        case RTC_ERROR_NONE:
            break;
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

EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

Hit EmbreeScene::closestHit(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return impl_->intersect(ray, context);
}

bool EmbreeScene::occluded(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return impl_->isOccluded(ray, context);
}

void EmbreeScene::closestHit(std::span<const Ray> rays, std::span<Hit> hits) const {
    if (hits.size() < rays.size()) throw Error("{} rays but room for {} hits", rays.size(), hits.size());
    impl_->forEachRay(
        rays, [&](size_t i, RTCIntersectContext& context) { hits[i] = impl_->intersect(rays[i], context); });
}

void EmbreeScene::occluded(std::span<const Ray> rays, std::span<uint32_t> results) const {
    if (results.size() < rays.size())
        throw Error("{} rays but room for {} results", rays.size(), results.size());
    impl_->forEachRay(rays, [&](size_t i, RTCIntersectContext& context) {
        results[i] = impl_->isOccluded(rays[i], context) ? 1u : 0u;
    });
}

size_t EmbreeScene::memoryBytes() const {
    return size_t(std::max<ptrdiff_t>(impl_->bytes, 0));
}

}  // namespace voxray
