#include "gpu/trace_kinds.h"
#include "gpu/trace_scenes.h"
#include "gpu/vulkan_fixture.h"
#include "trace/ray_pipeline_tracer.h"
#include "trace/ray_query_tracer.h"
#include "trace/ray_tracer.h"

namespace voxray {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Each test runs on every backend that the device has.
class TraceBackends : public VulkanTest {
 protected:
    static std::unique_ptr<RayTracer> make(TracerKind kind, const SceneState& state) {
        ShaderCompiler shaders = compiler();
        return makeRayTracer(kind, device(), shaders, state);
    }
    static std::vector<Hit> closestHits(RayTracer& tracer, const std::vector<Ray>& rays) {
        const Buffer rayBuffer(device(), "rays", rays.size() * sizeof(Ray));
        const Buffer hitBuffer(device(), "hits", rays.size() * sizeof(Hit));
        CommandStream stream(device());
        stream.upload(rayBuffer, rays);
        stream.fill(hitBuffer, 0);
        tracer.closestHit(stream, rayBuffer, hitBuffer, uint32_t(rays.size()));
        return stream.readAs<Hit>(hitBuffer, rays.size());
    }
    static std::vector<uint32_t> occlusions(RayTracer& tracer, const std::vector<Ray>& rays) {
        const Buffer rayBuffer(device(), "rays", rays.size() * sizeof(Ray));
        const Buffer results(device(), "results", rays.size() * sizeof(uint32_t));
        CommandStream stream(device());
        stream.upload(rayBuffer, rays);
        stream.fill(results, 7);
        tracer.occluded(stream, rayBuffer, results, uint32_t(rays.size()));
        return stream.readAs<uint32_t>(results, rays.size());
    }

    /// Fails unless all but a few rays in 10,000 (grazed edges) meet the same triangle at the same place.
    static void expectSameHits(const std::vector<Hit>& expected, const std::vector<Hit>& hits, std::string_view name) {
        size_t differences = 0;
        for (size_t i = 0; i < expected.size(); ++i) {
            const Hit &a = expected[i], &b = hits[i];
            if (a.triangle != b.triangle) {
                ++differences;
                continue;
            }
            if (a.triangle == Hit::kMiss) {
                EXPECT_EQ(a.t, b.t) << name << " ray " << i;
                continue;
            }
            EXPECT_NEAR(b.t, a.t, 1e-4f * a.t) << name << " ray " << i;
            EXPECT_NEAR(b.u, a.u, 2e-3f) << name << " ray " << i;
            EXPECT_NEAR(b.v, a.v, 2e-3f) << name << " ray " << i;
        }
        EXPECT_LE(differences, expected.size() / 10000) << name << ": of " << expected.size() << " rays";
    }
};

TEST_F(TraceBackends, AnAlphaAtTheCutoffIsOpaque) {
    TestRandom random(4);
    std::vector<Ray> rays(512);
    for (Ray& ray : rays) ray = {{random(0.01f, 0.99f), random(0.01f, 0.99f), 1}, 0, {0, 0, -1}, kInfinity};
    for (const auto& [code, factor, vertex] :
         {std::tuple{128, 1.0, 1.0}, {77, 0.6, 1.0}, {255, 0.3, 0.7}, {201, 0.81, 0.37}}) {
        const SceneState state = alphaAtCutoff(uint8_t(code), factor, vertex);
        for (TracerKind kind : tracerKinds(device())) {
            const std::unique_ptr<RayTracer> tracer = make(kind, state);
            EXPECT_EQ(std::ranges::count(occlusions(*tracer, rays), 1u), 512) << tracer->name() << code;
        }
    }
}

TEST_F(TraceBackends, AgreeOnATriangleSoupWithAlphaMasks) {
    const SceneState state = triangleSoup(1500, 0.12f, 1);
    const std::vector<Ray> rays = randomRays(10000, 2);
    const std::vector<Hit> expected = closestHits(*make(TracerKind::Embree, state), rays);

    // The scene must ask something of the backends: hits on every material, and misses.
    std::vector<size_t> hitsOfMaterial(state.scene->materials.size());
    size_t misses = 0;
    for (const Hit& hit : expected) {
        if (hit.triangle == Hit::kMiss)
            ++misses;
        else
            ++hitsOfMaterial[state.geometry.triangleMaterials[hit.triangle]];
    }
    EXPECT_GT(misses, 500u);
    for (size_t count : hitsOfMaterial) EXPECT_GT(count, 50u);
    for (TracerKind kind : tracerKinds(device())) {
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        expectSameHits(expected, closestHits(*tracer, rays), tracer->name());
        EXPECT_EQ(tracer->raysTraced(), rays.size());
        EXPECT_GT(tracer->memoryBytes(), 0u);
    }
}

TEST_F(TraceBackends, MasksCutHoles) {
    // The same soup without masks has more hits: the test above can fail.
    SceneState state = triangleSoup(1500, 0.12f, 1);
    const std::vector<Ray> rays = randomRays(5000, 2);
    auto unmasked = std::make_shared<Scene>(*state.scene);
    for (Material& material : unmasked->materials) material.alphaMode = AlphaMode::Opaque;
    for (TracerKind kind : tracerKinds(device())) {
        const std::vector<Hit> cut = closestHits(*make(kind, state), rays);
        SceneState whole = state;
        whole.scene = unmasked;
        const std::vector<Hit> full = closestHits(*make(kind, whole), rays);
        size_t nearer = 0;
        for (size_t i = 0; i < rays.size(); ++i) nearer += full[i].t < cut[i].t;
        EXPECT_GT(nearer, 300u);
    }
}

TEST_F(TraceBackends, OccludedIsWhetherThereIsAClosestHit) {
    const SceneState state = triangleSoup(2000, 0.1f, 3);
    const std::vector<Ray> rays = randomRays(4000, 4);
    for (TracerKind kind : tracerKinds(device())) {
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        const std::vector<Hit> hits = closestHits(*tracer, rays);
        const std::vector<uint32_t> occluded = occlusions(*tracer, rays);
        size_t differences = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            ASSERT_LE(occluded[i], 1u);
            differences += (hits[i].triangle != Hit::kMiss) != (occluded[i] == 1);
        }
        EXPECT_LE(differences, 1u) << tracer->name();
    }
}

TEST_F(TraceBackends, HitOnOneTriangleHasItsClosedForm) {
    const SceneState state = oneTriangle();
    const std::vector<Ray> rays{
        {{0.25f, 0.5f, 2}, 0, {0, 0, -4}, 10},         // From the front: t counts in directions.
        {{0.25f, 0.5f, -2}, 0, {0, 0, 1}, kInfinity},  // From behind.
        {{0.75f, 0.75f, 2}, 0, {0, 0, -1}, 10},        // Next to it.
        {{0.25f, 0.25f, 2}, 0, {0, 0, -1}, 1.5f},      // Ends before it.
        {{0.25f, 0.25f, 2}, 2.5f, {0, 0, -1}, 10},     // Begins behind it.
    };
    for (TracerKind kind : tracerKinds(device())) {
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        const std::vector<Hit> hits = closestHits(*tracer, rays);
        EXPECT_EQ(hits[0].triangle, 0u);
        EXPECT_NEAR(hits[0].t, 0.5f, 1e-6f);
        EXPECT_NEAR(hits[0].u, 0.25f, 1e-6f);
        EXPECT_NEAR(hits[0].v, 0.5f, 1e-6f);
        EXPECT_EQ(hits[1].triangle, 0u);
        EXPECT_NEAR(hits[1].t, 2.0f, 1e-6f);
        for (size_t i = 2; i < rays.size(); ++i) {
            EXPECT_EQ(hits[i].triangle, Hit::kMiss) << tracer->name() << " ray " << i;
            EXPECT_EQ(hits[i].t, rays[i].tMax);
        }
        EXPECT_EQ(occlusions(*tracer, rays), (std::vector<uint32_t>{1, 1, 0, 0, 0})) << tracer->name();
    }
}

TEST_F(TraceBackends, HitCloseToItsRayKeepsItsDigitsFarFromTheOrigin) {
    // A millimetre away at 100 m: one unit in the last place there is 0.8 % of the distance.
    SceneState state = oneTriangle();
    for (glm::vec3& position : state.geometry.positions) position += glm::vec3(100, 100, 0.3f);
    const float z = state.geometry.positions[0].z, millimetre = 0x1p-10f;
    const std::vector<Ray> rays{{{100.25f, 100.25f, z + millimetre}, 0, {0.6f, 0, -0.8f}, 10}};
    const float expected = ((z + millimetre) - z) / 0.8f;
    for (TracerKind kind : tracerKinds(device())) {
        const std::vector<Hit> hits = closestHits(*make(kind, state), rays);
        EXPECT_EQ(hits[0].triangle, 0u);
        EXPECT_NEAR(hits[0].t, expected, 1e-5f * expected) << int(kind);
    }
}

TEST_F(TraceBackends, InactiveRaysMiss) {
    const SceneState state = oneTriangle();
    const std::vector<Ray> rays{{{0.25f, 0.25f, 2}, 1, {0, 0, -1}, 0.5f}, {{0.25f, 0.25f, 2}, 0, {0, 0, -1}, -1}};
    for (TracerKind kind : tracerKinds(device())) {
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        for (const Hit& hit : closestHits(*tracer, rays)) EXPECT_EQ(hit.triangle, Hit::kMiss);
        EXPECT_EQ(occlusions(*tracer, rays), (std::vector<uint32_t>{0, 0})) << tracer->name();
    }
}

TEST_F(TraceBackends, RaysThatAreNotFiniteMissOnTheGpuAndAreNamedByEmbree) {
    const SceneState state = oneTriangle();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Ray> rays{
        {{nan, 0.25f, 2}, 0, {0, 0, -1}, 10},           {{0.25f, 0.25f, 2}, 0, {0, nan, -1}, 10},
        {{0.25f, 0.25f, kInfinity}, 0, {0, 0, -1}, 10}, {{0.25f, 0.25f, 2}, nan, {0, 0, -1}, 10},
        {{0.25f, 0.25f, 2}, 0, {0, 0, -1}, nan},        {{0.25f, 0.25f, 0}, 0, {0, 0, 0}, 10}};
    for (TracerKind kind : tracerKinds(device())) {
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        if (kind == TracerKind::Embree) {
            EXPECT_ERROR("ray 0 of a stream of 6", closestHits(*tracer, rays));
            continue;
        }
        for (const Hit& hit : closestHits(*tracer, rays)) EXPECT_EQ(hit.triangle, Hit::kMiss);
        EXPECT_EQ(occlusions(*tracer, rays), std::vector<uint32_t>(rays.size(), 0)) << tracer->name();
    }
}

TEST_F(TraceBackends, EmptySceneIsMissed) {
    const SceneState state = emptyScene();
    const std::vector<Ray> rays = randomRays(100, 5);
    for (TracerKind kind : tracerKinds(device())) {
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        const std::vector<Hit> hits = closestHits(*tracer, rays);
        for (size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(hits[i].triangle, Hit::kMiss) << tracer->name();
            EXPECT_EQ(hits[i].t, rays[i].tMax);
        }
        EXPECT_EQ(occlusions(*tracer, rays), std::vector<uint32_t>(rays.size(), 0)) << tracer->name();
    }
}

TEST_F(TraceBackends, DegenerateTrianglesAreMissed) {
    // Rays at the center of triangles that are a point or a line.
    SceneState state = oneTriangle();
    state.geometry.positions = {{0.5f, 0.5f, 0}, {0.5f, 0.5f, 0}, {0.5f, 0.5f, 0}, {0, 0, 1}, {1, 0, 1}, {0.5f, 0, 1}};
    state.geometry.attributes.resize(6);
    state.geometry.triangles = {{0, 1, 2}, {3, 4, 5}};
    state.geometry.triangleMaterials = {0, 0};
    const std::vector<Ray> rays{{{0.5f, 0.5f, 5}, 0, {0, 0, -1}, 10}, {{0.4f, 0, 5}, 0, {0, 0, -1}, 10}};
    for (TracerKind kind : tracerKinds(device())) {
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        for (const Hit& hit : closestHits(*tracer, rays)) EXPECT_EQ(hit.triangle, Hit::kMiss) << tracer->name();
    }
}

TEST_F(TraceBackends, ManyChunksAgreeWithOne) {
    // Bottom-level structures of 100 triangles: numbers and masks must survive the split.
    const SceneState state = triangleSoup(1000, 0.15f, 6);
    const std::vector<Ray> rays = randomRays(5000, 7);
    ShaderCompiler shaders = compiler();
    const std::vector<Hit> expected = closestHits(*make(TracerKind::Embree, state), rays);
    if (device().info().rayQuery) {
        RayQueryTracer tracer(device(), shaders, state, 100);
        expectSameHits(expected, closestHits(tracer, rays), tracer.name());
    }
    if (device().info().rayPipeline) {
        RayPipelineTracer tracer(device(), shaders, state, 100);
        expectSameHits(expected, closestHits(tracer, rays), tracer.name());
    }
}

TEST_F(TraceBackends, StreamsLargerThanOneLaunchAreTracedWhole) {
    // 4.2 million rays: more than one launch, and more rays than software Vulkan binds in one buffer.
    const SceneState state = oneTriangle();
    const uint32_t count = 65535 * 64 + 1000;
    std::vector<Ray> rays(count, Ray{{5, 5, 2}, 0, {0, 0, -1}, 10});
    rays[0].origin = rays[count / 2].origin = rays[count - 1].origin = {0.25f, 0.25f, 2};
    for (TracerKind kind : tracerKinds(device())) {
        if (kind == TracerKind::Embree) continue;
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        const std::vector<uint32_t> occluded = occlusions(*tracer, rays);
        size_t sum = 0;
        for (uint32_t value : occluded) sum += value;
        EXPECT_EQ(sum, 3u) << tracer->name();
        EXPECT_EQ(occluded[0] + occluded[count / 2] + occluded[count - 1], 3u) << tracer->name();
    }
}

TEST_F(TraceBackends, SmallBuffersAreNamed) {
    const SceneState state = oneTriangle();
    const Buffer rays(device(), "few rays", 3 * sizeof(Ray)), hits(device(), "few hits", 3 * sizeof(Hit));
    const Buffer more(device(), "more rays", 4 * sizeof(Ray));
    CommandStream stream(device());
    for (TracerKind kind : tracerKinds(device())) {
        const std::unique_ptr<RayTracer> tracer = make(kind, state);
        EXPECT_ERROR("'few rays'", tracer->closestHit(stream, rays, hits, 4));
        EXPECT_ERROR("'few hits'", tracer->closestHit(stream, more, hits, 4));
        tracer->closestHit(stream, rays, hits, 0);
        stream.finish();
    }
}

TEST_F(TraceBackends, AutoIsEmbreeOnSoftwareVulkanAndNamedKindsStay) {
    if (device().info().isCpu) {
        EXPECT_EQ(resolveTracer(TracerKind::Auto, device()), TracerKind::Embree);
    }
    EXPECT_NE(resolveTracer(TracerKind::Auto, device()), TracerKind::Auto);
    EXPECT_EQ(resolveTracer(TracerKind::RayPipeline, device()), TracerKind::RayPipeline);
}

TEST_F(TraceBackends, TracersGiveTheirMemoryBack) {
    const uint64_t before = device().memoryUsedBytes();
    const SceneState state = triangleSoup(500, 0.1f, 8);
    for (TracerKind kind : tracerKinds(device())) make(kind, state);
    EXPECT_EQ(device().memoryUsedBytes(), before);
}

}  // namespace
}  // namespace voxray
