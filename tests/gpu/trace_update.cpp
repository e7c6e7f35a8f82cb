#include <cstring>

#include "gpu/trace_kinds.h"
#include "gpu/trace_scenes.h"
#include "gpu/vulkan_fixture.h"
#include "shaders/scene/scene_types.h"
#include "trace/gpu_scene.h"
#include "trace/ray_query_tracer.h"
#include "trace/ray_tracer.h"

namespace voxray {
namespace {

/// Triangles of all of the soup's materials, masked ones too: of each material a mesh that stays and one on a
/// node that travels, turns and is mirrored, whose triangles morph, and a lamp that rides along.
std::shared_ptr<const Scene> movingSoup() {
    TestRandom random(7);
    const std::shared_ptr<Scene> scene = soupMaterials(random);
    Material lamp;
    lamp.emission = {1, 2, 3};
    scene->materials.push_back(lamp);
    scene->nodes.resize(1);
    for (uint32_t material = 0; material < scene->materials.size(); ++material)
        for (const int32_t node : {-1, 0}) {
            Mesh mesh;
            mesh.material = material;
            for (uint32_t t = 0; t < 150; ++t) {
                const glm::vec3 center = random.vector(-1, 1);
                for (int corner = 0; corner < 3; ++corner) {
                    mesh.positions.push_back(center + random.vector(-0.12f, 0.12f));
                    mesh.normals.emplace_back(0, 1, 0);
                    mesh.texCoords0.emplace_back(random(-1.5f, 1.5f), random(-1.5f, 1.5f));
                    mesh.texCoords1.emplace_back(random(-1.5f, 1.5f), random(-1.5f, 1.5f));
                    mesh.colors.emplace_back(1, 1, 1, random(0, 1));
                }
                mesh.triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
            }
            if (node == 0) {
                MorphTarget& target = mesh.morph.targets.emplace_back();
                for (size_t v = 0; v < mesh.positions.size(); ++v) {
                    target.positions.push_back(random.vector(-0.1f, 0.1f));
                    target.normals.push_back(random.vector(-1, 1));
                }
            }
            scene->instances.push_back({.mesh = uint32_t(scene->meshes.size()), .node = node, .morph = node});
            scene->meshes.push_back(std::move(mesh));
        }
    using enum AnimatedProperty;
    scene->animation = {{0, Translation, Interpolation::Linear, {0, 1}, {{-0.4f, 0, 0, 0}, {0.4f, 0.3f, 0, 0}}},
                        {0, Rotation, Interpolation::Linear, {0, 1}, {{0, 0, 0, 1}, {0.6f, 0, 0, 0.8f}}},
                        {0, Scale, Interpolation::Linear, {0, 1}, {{1, 1, 1, 0}, {-1, 1, 1, 0}}}};
    scene->morphs = {{.targetCount = 1, .timesSeconds = {0, 1}, .values = {0, 1}}};
    scene->lights.emplace_back();
    scene->lights[0].node = 0;
    return scene;
}

class TraceUpdate : public VulkanTest {
 protected:
    template <typename T>
    static bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
    }
    static std::vector<Hit> closestHits(RayTracer& tracer, const std::vector<Ray>& rays,
                                        Coherence coherence = Coherence::Incoherent) {
        return trace<Hit>(rays, [&](CommandStream& stream, const Buffer& from, const Buffer& to) {
            tracer.closestHit(stream, from, to, uint32_t(rays.size()), coherence);
        });
    }
    static std::vector<uint32_t> occlusions(RayTracer& tracer, const std::vector<Ray>& rays,
                                            Coherence coherence = Coherence::Incoherent) {
        return trace<uint32_t>(rays, [&](CommandStream& stream, const Buffer& from, const Buffer& to) {
            tracer.occluded(stream, from, to, uint32_t(rays.size()), coherence);
        });
    }

 private:
    template <typename Result>
    static std::vector<Result> trace(const std::vector<Ray>& rays, const auto& call) {
        const Buffer from(device(), "rays", rays.size() * sizeof(Ray));
        const Buffer to(device(), "results", rays.size() * sizeof(Result));
        CommandStream stream(device());
        stream.upload(from, rays);
        call(stream, from, to);
        return stream.readAs<Result>(to, rays.size());
    }
};

TEST_F(TraceUpdate, EveryTracerIsAsOneMadeAtThatTime) {
    const auto scene = movingSoup();
    const std::vector<Ray> rays = randomRays(4000, 8);
    for (const TracerKind kind : tracerKinds(device())) {
        ShaderCompiler shaders = compiler();
        SceneState state = evaluate(scene, 0.1, Playback::Looping);
        const auto tracer = makeRayTracer(kind, device(), shaders, state);
        std::vector<Hit> before = closestHits(*tracer, rays);
        for (const double time : {0.8, 0.2}) {
            CommandStream stream(device());
            advance(state, time);
            tracer->update(stream);
            const SceneState there = evaluate(scene, time, Playback::Looping);
            const auto made = makeRayTracer(kind, device(), shaders, there);
            const std::vector<Hit> hits = closestHits(*tracer, rays);
            EXPECT_TRUE(sameBytes(hits, closestHits(*made, rays))) << tracer->name() << " at " << time;
            EXPECT_EQ(occlusions(*tracer, rays), occlusions(*made, rays)) << tracer->name() << " at " << time;
            EXPECT_FALSE(sameBytes(hits, before));
            before = hits;

            // One frozen there has no part of its own for what moves: the same but for rounding and ties.
            const SceneState frozen = evaluate(scene, time);
            const std::vector<Hit> whole = closestHits(*makeRayTracer(kind, device(), shaders, frozen), rays);
            size_t different = 0, movingHits = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                different += hits[i].triangle != whole[i].triangle;
                movingHits += hits[i].triangle != Hit::kMiss && hits[i].triangle / 150 % 2 == 1;
            }
            EXPECT_LE(different, 2u) << tracer->name();
            EXPECT_GT(movingHits, 400u);
        }
    }
}

TEST_F(TraceUpdate, CoherentStreamsHitTheSame) {
    std::vector<Ray> rays = randomRays(4001, 10);  // The last packet has one ray.
    for (size_t i = 0; i < rays.size(); i += 7) rays[i].tMax = -1.0f;
    for (const TracerKind kind : tracerKinds(device())) {
        ShaderCompiler shaders = compiler();
        const SceneState state = evaluate(movingSoup(), 0.1, Playback::Looping);
        const auto tracer = makeRayTracer(kind, device(), shaders, state);
        const std::vector<Hit> apart = closestHits(*tracer, rays);
        const std::vector<Hit> together = closestHits(*tracer, rays, Coherence::Coherent);
        const std::vector<uint32_t> hidden = occlusions(*tracer, rays, Coherence::Coherent);
        size_t different = 0, hitCount = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            hitCount += apart[i].triangle != Hit::kMiss;
            different +=
                apart[i].triangle != together[i].triangle || (apart[i].triangle != Hit::kMiss) != (hidden[i] == 1);
            if (apart[i].triangle != together[i].triangle) continue;
            if (apart[i].triangle == Hit::kMiss) {
                EXPECT_EQ(together[i].t, apart[i].t) << tracer->name() << i;
                continue;
            }
            EXPECT_NEAR(together[i].t, apart[i].t, 1e-5f * apart[i].t) << tracer->name() << i;
            EXPECT_NEAR(together[i].u, apart[i].u, 1e-3f) << tracer->name() << i;
            EXPECT_NEAR(together[i].v, apart[i].v, 1e-3f) << tracer->name() << i;
        }
        EXPECT_LE(different, 2u) << tracer->name();
        EXPECT_GT(hitCount, 800u);
    }
}

TEST_F(TraceUpdate, ManyChunksAreRebuiltInTheirPlaces) {
    if (!device().info().rayQuery) GTEST_SKIP() << "no ray queries";
    const auto scene = movingSoup();
    const std::vector<Ray> rays = randomRays(2000, 9);
    ShaderCompiler shaders = compiler();
    SceneState state = evaluate(scene, 0.1, Playback::Looping);
    RayQueryTracer tracer(device(), shaders, state, 100);
    CommandStream stream(device());
    advance(state, 0.8);
    tracer.update(stream);
    RayQueryTracer made(device(), shaders, state, 100);
    EXPECT_TRUE(sameBytes(closestHits(tracer, rays), closestHits(made, rays)));
    EXPECT_EQ(tracer.memoryBytes(), made.memoryBytes());
}

TEST_F(TraceUpdate, SceneOnTheDeviceIsAsOneMadeAtThatTime) {
    const auto scene = movingSoup();
    CommandStream stream(device());
    SceneState state = evaluate(scene, 0.1, Playback::Looping);
    GpuScene updated = makeGpuScene(device(), stream, state);
    for (const double time : {0.7, 0.3}) {
        advance(state, time);
        updateGpuScene(stream, state, updated);
        const GpuScene made = makeGpuScene(device(), stream, evaluate(scene, time, Playback::Looping));
        EXPECT_EQ(updated.emitterCount, made.emitterCount);
        EXPECT_EQ(updated.lightCount, 1u);
        const auto expectSame = [&](Buffer GpuScene::*buffer) {
            const Buffer &a = updated.*buffer, &b = made.*buffer;
            ASSERT_EQ(a.bytes(), b.bytes());
            EXPECT_EQ(stream.read(a, a.bytes()), stream.read(b, b.bytes())) << a.name() << " at " << time;
        };
        for (const auto buffer : {&GpuScene::positions, &GpuScene::attributes, &GpuScene::triangles, &GpuScene::lights,
                                  &GpuScene::emitters, &GpuScene::lightTree})
            expectSame(buffer);
    }
}

}  // namespace
}  // namespace voxray
