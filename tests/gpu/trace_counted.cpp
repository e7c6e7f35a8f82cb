// Streams whose length the device counts.
#include "gpu/trace_kinds.h"
#include "gpu/trace_scenes.h"
#include "gpu/vulkan_fixture.h"
#include "shaders/trace/stream_count.h"
#include "trace/counted_rays.h"

namespace voxray {
namespace {

class TraceCounted : public VulkanTest {
 protected:
    static std::unique_ptr<RayTracer> make(TracerKind kind, const SceneState& state) {
        ShaderCompiler shaders = compiler();
        return makeRayTracer(kind, device(), shaders, state);
    }
};

TEST_F(TraceCounted, RaysBeyondTheCountAreNotTraced) {
    // All rays meet the triangle; the second of three counts holds
    constexpr uint32_t kRays = 1000, kUntouched = 7;
    const SceneState state = oneTriangle();
    const std::vector<Ray> rays(kRays, Ray{{0.25f, 0.25f, 2}, 0, {0, 0, -1}, 10});
    const Buffer rayBuffer(device(), "rays", kRays * sizeof(Ray)), hits(device(), "hits", kRays * sizeof(Hit));
    const Buffer results(device(), "results", kRays * sizeof(uint32_t));
    const Buffer counts(device(), "counts", 3 * sizeof(gpu::StreamCount));
    for (const TracerKind kind : tracerKinds(device()))
        for (const uint32_t count : {0u, 1u, 64u, 65u, 777u, kRays}) {
            const std::unique_ptr<RayTracer> tracer = make(kind, state);
            EXPECT_EQ(waitsForCounts(*tracer), kind == TracerKind::Embree);
            CommandStream stream(device());
            stream.upload(rayBuffer, rays);
            const uint32_t groups = (count + STREAM_GROUP - 1) / STREAM_GROUP;
            stream.upload(counts, std::vector<gpu::StreamCount>{
                                      {1, 1, 1, 3, 1, 1}, {groups, 1, 1, count, 1, 1}, {1, 1, 1, 5, 1, 1}});
            stream.fill(hits, kUntouched);
            stream.fill(results, kUntouched);
            closestHit(*tracer, stream, rayBuffer, hits, {counts, 1, kRays});
            occluded(*tracer, stream, rayBuffer, results, {counts, 1, kRays});
            const std::vector<Hit> found = stream.readAs<Hit>(hits, kRays);
            const std::vector<uint32_t> blocked = stream.readAs<uint32_t>(results, kRays);
            for (uint32_t i = 0; i < kRays; ++i) {
                EXPECT_EQ(found[i].triangle, i < count ? 0 : kUntouched) << tracer->name() << " " << count << " " << i;
                EXPECT_EQ(blocked[i], i < count ? 1 : kUntouched) << tracer->name() << " " << count << " " << i;
            }
        }
}

TEST_F(TraceCounted, BuffersAndStreamsThatDoNotFitAreNamed) {
    const SceneState state = oneTriangle();
    const Buffer rays(device(), "few rays", 3 * sizeof(Ray)), hits(device(), "few hits", 3 * sizeof(Hit));
    const Buffer counts(device(), "counts", sizeof(gpu::StreamCount));
    CommandStream stream(device());
    for (const TracerKind kind : tracerKinds(device())) {
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        EXPECT_ERROR("'few rays'", closestHit(*tracer, stream, rays, hits, {counts, 0, 4}));
        EXPECT_ERROR("are possible", occluded(*tracer, stream, rays, hits, {counts, 0, CountedRays::kMost + 1}));
    }
}

}  // namespace
}  // namespace voxray
