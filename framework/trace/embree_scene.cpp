#include "trace/embree_scene.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "trace/embree_bvh.h"

namespace voxray {

namespace {

/// Embree's bound on coordinates (FLT_LARGE): Debian's build aborts on rays beyond it.
constexpr float kLargest = 1.8e18f;
constexpr size_t kStreamGrain = 4096;
/// Rays of an incoherent stream that are traced together (intersectBlock).
constexpr size_t kBlock = 64;
/// Rays per packet: the width of AVX-512. With AVX2 Embree traces two of eight, in the time of two.
constexpr uint32_t kPacket = EmbreeScene::kPacketRays;

/// Half of a ray: origin and tMin, or direction and tMax.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));
static_assert(offsetof(Ray, tMin) == 12 && offsetof(Ray, direction) == 16 && sizeof(Ray) == 32);

Float4 load(const glm::vec3& first) {
    Float4 half;
    std::memcpy(&half, &first, sizeof(half));
    return half;
}

/// Vectorized and branchless, since it runs on every ray of a stream. False for NaN.
bool isTraceable(const Ray& ray) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const Float4 origin = load(ray.origin), direction = load(ray.direction);
    const Int4 isWithin = (origin >= Float4{-kLargest, -kLargest, -kLargest, 0}) &
                          (origin <= Float4{kLargest, kLargest, kLargest, kLargest}) &
                          (direction >= Float4{-kLargest, -kLargest, -kLargest, -kInfinity}) &
                          (direction <= Float4{kLargest, kLargest, kLargest, kInfinity});
    int64_t halves[2];
    std::memcpy(halves, &isWithin, sizeof(halves));
    return (halves[0] & halves[1]) == -1;
}

bool isActive(const Ray& ray) {
    return ray.tMax >= ray.tMin;
}

/// Converts a ray with stores as wide as Embree's loads, for store forwarding.
void toEmbree(const Ray& ray, RTCRay& out) {
    const Float4 origin = load(ray.origin);
    const Int4 direction = reinterpret_cast<Int4>(load(ray.direction)) & Int4{-1, -1, -1, 0};  // Time 0.
    std::memcpy(&out.org_x, &origin, sizeof(origin));
    std::memcpy(&out.dir_x, &direction, sizeof(direction));
    out.tfar = ray.tMax;
    out.mask = 0xffffffffu;
    out.id = 0;
    out.flags = 0;
}

/// Adjacent rays of a coherent stream, traced together.
struct Packet {
    alignas(64) int active[kPacket];  ///< -1: active, as in Embree.
    RTCRayHit16 query{};

    explicit Packet(std::span<const Ray> rays) {
        RTCRay16& out = query.ray;
        for (uint32_t k = 0; k < kPacket; ++k) {
            const Ray ray = k < rays.size() ? rays[k] : Ray{{}, 0.0f, {0.0f, 0.0f, 1.0f}, -1.0f};
            active[k] = isActive(ray) ? -1 : 0;
            out.org_x[k] = ray.origin.x;
            out.org_y[k] = ray.origin.y;
            out.org_z[k] = ray.origin.z;
            out.dir_x[k] = ray.direction.x;
            out.dir_y[k] = ray.direction.y;
            out.dir_z[k] = ray.direction.z;
            out.tnear[k] = ray.tMin;
            out.tfar[k] = ray.tMax;
            out.mask[k] = 0xffffffffu;
        }
    }
};

}  // namespace

struct EmbreeScene::Impl : EmbreeBvh {
    /// Up to kBlock incoherent rays. Doing each step for all rays before the next is faster than ray by ray.
    void intersectBlock(std::span<const Ray> rays, std::span<Hit> hits, EmbreeQuery& embree) const {
        std::array<RTCRayHit, kBlock> queries;
        for (size_t i = 0; i < rays.size(); ++i) {
            toEmbree(rays[i], queries[i].ray);
            hits[i] = {rays[i].tMax, Hit::kMiss, 0.0f, 0.0f};
        }
        for (const Bvh* bvh : {&staticBvh, &dynamicBvh}) {
            if (!bvh->scene) break;
            for (size_t i = 0; i < rays.size(); ++i) queries[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
            for (size_t i = 0; i < rays.size(); ++i)
                if (isActive(rays[i])) embree.intersect(bvh->scene, queries[i]);
            for (size_t i = 0; i < rays.size(); ++i) {
                const RTCRayHit& found = queries[i];
                if (found.hit.geomID != RTC_INVALID_GEOMETRY_ID)
                    hits[i] = {found.ray.tfar, bvh->triangleOf(found.hit), found.hit.u, found.hit.v};
            }
        }
    }

    void occludedBlock(std::span<const Ray> rays, std::span<uint32_t> results, EmbreeQuery& embree) const {
        std::array<RTCRay, kBlock> queries;
        for (size_t i = 0; i < rays.size(); ++i) toEmbree(rays[i], queries[i]);
        for (size_t i = 0; i < rays.size(); ++i)
            if (isActive(rays[i])) embree.occluded(staticBvh.scene, queries[i]);
        if (dynamicBvh.scene)
            for (size_t i = 0; i < rays.size(); ++i)
                if (isActive(rays[i]) && queries[i].tfar >= 0.0f) embree.occluded(dynamicBvh.scene, queries[i]);
        for (size_t i = 0; i < rays.size(); ++i) results[i] = isActive(rays[i]) && queries[i].tfar < 0.0f ? 1u : 0u;
    }

    void intersectPacket(std::span<const Ray> rays, std::span<Hit> hits, EmbreeQuery& embree) const {
        Packet packet(rays);
        RTCRayHit16& query = packet.query;
        for (size_t k = 0; k < rays.size(); ++k) hits[k] = {rays[k].tMax, Hit::kMiss, 0.0f, 0.0f};
        for (const Bvh* bvh : {&staticBvh, &dynamicBvh}) {
            if (!bvh->scene) break;
            std::fill_n(query.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
            embree.intersect(packet.active, bvh->scene, query);
            for (size_t k = 0; k < rays.size(); ++k) {
                if (query.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
                RTCHit hit{};
                hit.primID = query.hit.primID[k];
                hit.geomID = query.hit.geomID[k];
                hits[k] = {query.ray.tfar[k], bvh->triangleOf(hit), query.hit.u[k], query.hit.v[k]};
            }
        }
    }

    void occludedPacket(std::span<const Ray> rays, std::span<uint32_t> results, EmbreeQuery& embree) const {
        Packet packet(rays);
        RTCRay16& query = packet.query.ray;
        embree.occluded(packet.active, staticBvh.scene, query);
        if (dynamicBvh.scene) {
            for (uint32_t k = 0; k < kPacket; ++k)
                if (query.tfar[k] < 0.0f) packet.active[k] = 0;
            embree.occluded(packet.active, dynamicBvh.scene, query);
        }
        for (size_t k = 0; k < rays.size(); ++k) results[k] = isActive(rays[k]) && query.tfar[k] < 0.0f ? 1u : 0u;
    }

    /// Checks all rays of a stream and calls trace(first, count, embree) for packets of kSize, in parallel.
    /// Packets don't depend on how the work is divided.
    template <size_t kSize, typename Trace>
    void forEachPacket(std::span<const Ray> rays, const Trace& trace) const {
        std::atomic<size_t> firstInvalid{rays.size()};
        const size_t packets = (rays.size() + kSize - 1) / kSize;
        parallelRanges(packets, kStreamGrain / kSize, [&](size_t begin, size_t end) {
            EmbreeQuery embree(kSize == kPacket ? Coherence::Coherent : Coherence::Incoherent);
            const size_t last = std::min(end * kSize, rays.size());
            for (size_t first = begin * kSize; first < last; first += kSize) {
                const size_t count = std::min(kSize, last - first);
                for (size_t i = first; i < first + count; ++i) {
                    if (isTraceable(rays[i])) [[likely]]
                        continue;
                    size_t lowest = firstInvalid.load();
                    while (i < lowest && !firstInvalid.compare_exchange_weak(lowest, i)) {
                    }
                    return;
                }
                trace(first, count, embree);
            }
        });
        if (firstInvalid != rays.size())
            throw Error(
                "ray {} of a stream of {} is NaN, infinite, beyond {} m or has a negative tMin: "
                "mark unused rays with tMax < tMin",
                firstInvalid.load(), rays.size(), kLargest);
    }
};

EmbreeScene::EmbreeScene(const SceneState& state, ExpectedRays rays) : impl_(std::make_unique<Impl>()) {
    // Dynamic triangles are few and rebuilt in each frame: medium quality is as good and faster.
    if (rays == ExpectedRays::Many)
        impl_->build(state, RTC_BUILD_QUALITY_HIGH, RTC_BUILD_QUALITY_MEDIUM);
    else
        impl_->build(state, RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_LOW);
}

void EmbreeScene::update() {
    impl_->update();
}

EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

Hit EmbreeScene::closestHit(const Ray& ray) const {
    EmbreeQuery embree(Coherence::Incoherent);
    Hit hit;
    impl_->intersectBlock({&ray, 1}, {&hit, 1}, embree);
    return hit;
}

bool EmbreeScene::occluded(const Ray& ray) const {
    EmbreeQuery embree(Coherence::Incoherent);
    uint32_t isOccluded = 0;
    impl_->occludedBlock({&ray, 1}, {&isOccluded, 1}, embree);
    return isOccluded == 1;
}

void EmbreeScene::closestHitPacket(std::span<const Ray> rays, std::span<Hit> hits) const {
    EmbreeQuery embree(Coherence::Coherent);
    impl_->intersectPacket(rays, hits, embree);
}

void EmbreeScene::occludedPacket(std::span<const Ray> rays, std::span<uint32_t> results) const {
    EmbreeQuery embree(Coherence::Coherent);
    impl_->occludedPacket(rays, results, embree);
}

void EmbreeScene::closestHit(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence) const {
    if (hits.size() < rays.size()) throw Error("{} rays but room for {} hits", rays.size(), hits.size());
    if (coherence == Coherence::Coherent)
        impl_->forEachPacket<kPacket>(rays, [&](size_t first, size_t count, EmbreeQuery& embree) {
            impl_->intersectPacket(rays.subspan(first, count), hits.subspan(first, count), embree);
        });
    else
        impl_->forEachPacket<kBlock>(rays, [&](size_t first, size_t count, EmbreeQuery& embree) {
            impl_->intersectBlock(rays.subspan(first, count), hits.subspan(first, count), embree);
        });
}

void EmbreeScene::occluded(std::span<const Ray> rays, std::span<uint32_t> results, Coherence coherence) const {
    if (results.size() < rays.size()) throw Error("{} rays but room for {} results", rays.size(), results.size());
    if (coherence == Coherence::Coherent)
        impl_->forEachPacket<kPacket>(rays, [&](size_t first, size_t count, EmbreeQuery& embree) {
            impl_->occludedPacket(rays.subspan(first, count), results.subspan(first, count), embree);
        });
    else
        impl_->forEachPacket<kBlock>(rays, [&](size_t first, size_t count, EmbreeQuery& embree) {
            impl_->occludedBlock(rays.subspan(first, count), results.subspan(first, count), embree);
        });
}

size_t EmbreeScene::memoryBytes() const {
    return size_t(std::max<ptrdiff_t>(impl_->bytes, 0));
}

}  // namespace voxray
