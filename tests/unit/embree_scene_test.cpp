#include "trace/embree_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <csignal>
#include <limits>
#include <random>
#include <vector>

#include "base/error.h"
#include "base/interrupt.h"
#include "tests/support/errors.h"
#include "trace/texture_lookup.h"

namespace voxray {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A scene of separate triangles, three vertices each; material 0 is opaque, material 1 alpha-masked with a
/// texture whose left half is transparent.
struct Soup {
    SceneState state;

    Soup() {
        auto scene = std::make_shared<Scene>();
        Texture texture;
        texture.width = 2;
        texture.height = 1;
        texture.wrapU = texture.wrapV = Wrap::ClampToEdge;
        texture.rgba = {255, 255, 255, 0, 255, 255, 255, 255};
        scene->textures = {texture};
        scene->materials.resize(2);
        scene->materials[1].alphaMode = AlphaMode::Mask;
        scene->materials[1].baseColorTexture.texture = 0;
        state.scene = scene;
    }

    void add(glm::vec3 a, glm::vec3 b, glm::vec3 c, uint32_t material = 0) {
        const uint32_t first = uint32_t(state.geometry.positions.size());
        const glm::vec2 uvs[3] = {{0, 0}, {1, 0}, {0, 1}};
        const glm::vec3 corners[3] = {a, b, c};
        for (int i = 0; i < 3; ++i) {
            VertexAttributes attributes;
            attributes.texCoords = glm::vec4(uvs[i], 0, 0);
            state.geometry.positions.push_back(corners[i]);
            state.geometry.attributes.push_back(attributes);
        }
        state.geometry.triangles.push_back({first, first + 1, first + 2});
        state.geometry.triangleMaterials.push_back(material);
    }
};

TEST(EmbreeScene, AnInterruptStopsItsBuild) {
    Soup soup;
    for (int i = 0; i < 100000; ++i) soup.add({0, 0, float(-i)}, {4, 0, float(-i)}, {0, 4, float(-i)});
    for (const ExpectedRays rays : {ExpectedRays::Many, ExpectedRays::Few}) {
        const InterruptScope scope;
        testing::internal::CaptureStderr();
        std::raise(SIGINT);
        EXPECT_EQ(errorOf<Interrupted>([&] { const EmbreeScene scene(soup.state, rays); }), "interrupted");
        EXPECT_CONTAINS(testing::internal::GetCapturedStderr(), "voxray: stopping");
    }
    EXPECT_EQ(EmbreeScene(soup.state).closestHit({{1, 2, -2.5f}, 0, {0, 0, -1}, kInfinity}).triangle, 3u);
}

TEST(EmbreeScene, HitsReportDistanceTriangleAndBarycentrics) {
    Soup soup;
    soup.add({0, 0, -5}, {4, 0, -5}, {0, 4, -5});
    soup.add({0, 0, -2}, {4, 0, -2}, {0, 4, -2});
    const EmbreeScene scene(soup.state);
    const Hit hit = scene.closestHit({{1, 2, 0}, 0, {0, 0, -0.5f}, kInfinity});
    EXPECT_EQ(hit.triangle, 1u);
    EXPECT_FLOAT_EQ(hit.t, 4.0f);
    EXPECT_FLOAT_EQ(hit.u, 0.25f);
    EXPECT_FLOAT_EQ(hit.v, 0.5f);
    EXPECT_EQ(scene.closestHit({{1, 2, 0}, 4.1f, {0, 0, -0.5f}, kInfinity}).triangle, 0u);
    EXPECT_GT(scene.memoryBytes(), 0u);
}

TEST(EmbreeScene, MissesKeepTheirTMax) {
    Soup soup;
    soup.add({0, 0, -5}, {4, 0, -5}, {0, 4, -5});
    const EmbreeScene scene(soup.state);
    const Hit hit = scene.closestHit({{1, 1, 0}, 0, {0, 0, -1}, 4.9f});
    EXPECT_EQ(hit.triangle, Hit::kMiss);
    EXPECT_EQ(hit.t, 4.9f);
    EXPECT_FALSE(scene.occluded({{1, 1, 0}, 0, {0, 0, -1}, 4.9f}));
    EXPECT_TRUE(scene.occluded({{1, 1, 0}, 0, {0, 0, -1}, 5.1f}));
}

TEST(EmbreeScene, InactiveRaysMiss) {
    Soup soup;
    soup.add({0, 0, -5}, {4, 0, -5}, {0, 4, -5});
    const EmbreeScene scene(soup.state);
    const std::vector<Ray> rays{
        {{1, 1, 0}, 1, {0, 0, -1}, 0}, {{1, 1, 0}, 0, {0, 0, -1}, -kInfinity}, {{1, 1, 0}, 0, {0, 0, -1}, 10}};
    std::vector<Hit> hits(3);
    std::vector<uint32_t> occluded(3, 7);
    scene.closestHit(rays, hits);
    scene.occluded(rays, occluded);
    EXPECT_EQ(hits[0].triangle, Hit::kMiss);
    EXPECT_EQ(hits[1].triangle, Hit::kMiss);
    EXPECT_EQ(hits[2].triangle, 0u);
    EXPECT_EQ(occluded, (std::vector<uint32_t>{0, 0, 1}));
}

TEST(EmbreeScene, NoTrianglesMeansNoHits) {
    const Soup soup;
    const EmbreeScene scene(soup.state);
    EXPECT_EQ(scene.closestHit({{0, 0, 0}, 0, {0, 0, -1}, kInfinity}).triangle, Hit::kMiss);
    EXPECT_FALSE(scene.occluded({{0, 0, 0}, 0, {0, 0, -1}, kInfinity}));
}

TEST(EmbreeScene, DegenerateTrianglesAndZeroDirectionsAreHarmless) {
    Soup soup;
    soup.add({0, 0, -1}, {0, 0, -1}, {0, 0, -1});
    soup.add({0, 0, -1}, {1, 0, -1}, {2, 0, -1});
    soup.add({-9, -9, -5}, {30, -9, -5}, {-9, 30, -5});
    const EmbreeScene scene(soup.state);
    for (const glm::vec3 target : {glm::vec3(0, 0, -1), glm::vec3(1, 0, -1), glm::vec3(0.5f, 0, -1)})
        EXPECT_EQ(scene.closestHit({{0, 0, 0}, 0, target, kInfinity}).triangle, 2u);
    EXPECT_EQ(scene.closestHit({{0, 0, 0}, 0, {0, 0, 0}, 1}).triangle, Hit::kMiss);
}

TEST(EmbreeScene, MaskedTrianglesAreCutForEveryRay) {
    Soup soup;
    soup.add({0, 0, -3}, {4, 0, -3}, {0, 4, -3}, 1);
    soup.add({0, 0, -5}, {4, 0, -5}, {0, 4, -5}, 0);
    soup.add({0, 0, -4}, {4, 0, -4}, {0, 4, -4}, 1);
    const EmbreeScene scene(soup.state);
    // The mask's alpha passes 0.5 at u = 0.5, which is x = 2.
    for (const float x : {0.5f, 1.5f, 1.9f}) {
        EXPECT_EQ(scene.closestHit({{x, 0.5f, 0}, 0, {0, 0, -1}, kInfinity}).triangle, 1u) << x;
        EXPECT_FALSE(scene.occluded({{x, 0.5f, 0}, 0, {0, 0, -1}, 4.5f})) << x;
    }
    for (const float x : {2.1f, 3.0f}) {
        EXPECT_EQ(scene.closestHit({{x, 0.5f, 0}, 0, {0, 0, -1}, kInfinity}).triangle, 0u) << x;
        EXPECT_EQ(scene.closestHit({{x, 0.5f, 0}, 3.5f, {0, 0, -1}, kInfinity}).triangle, 2u) << x;
        EXPECT_TRUE(scene.occluded({{x, 0.5f, 0}, 0, {0, 0, -1}, 4.5f})) << x;
    }
}

TEST(AlphaMask, AnAlphaAtTheCutoffIsOpaqueAndOneBelowIsNot) {
    // Of factor, vertex colours and a texture of 8 bits, each alone and all together.
    Soup soup;
    soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
    auto scene = std::make_shared<Scene>(*soup.state.scene);
    soup.state.scene = scene;
    Material& material = scene->materials[1];
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 20000; ++i) {
        const uint8_t code = uint8_t(1 + i % 255);
        const double factor = i % 2 == 0 ? 1 : unit(random), vertex = i % 3 == 0 ? 1 : unit(random);
        scene->textures[0].rgba[3] = scene->textures[0].rgba[7] = code;
        material.baseColor.a = float(factor);
        for (VertexAttributes& a : soup.state.geometry.attributes) a.color.a = float(vertex);
        material.alphaCutoff = float(factor * vertex * code / 255);
        const float u = unit(random), v = unit(random) * (1 - u);
        ASSERT_FALSE(isCutAway(soup.state, 0, u, v)) << int(code) << " " << factor << " " << vertex;
        material.alphaCutoff *= 1.00001f;
        ASSERT_TRUE(isCutAway(soup.state, 0, u, v)) << int(code) << " " << factor << " " << vertex;
    }
}

TEST(Textures, NearestTakesOneTexel) {
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.rgba = {10, 0, 0, 255, 110, 0, 0, 255};
    const auto red = [&](float u) { return std::lround(255 * sampleTexture(texture, {u, 0.5f}).x); };
    texture.wrapU = Wrap::ClampToEdge;
    EXPECT_EQ(red(0.5f), 60);
    texture.filter = TexelFilter::Nearest;
    EXPECT_EQ(red(0.49f), 10);
    EXPECT_EQ(red(0.51f), 110);
    for (const Wrap wrap : {Wrap::Repeat, Wrap::ClampToEdge, Wrap::MirroredRepeat}) {
        texture.wrapU = wrap;
        EXPECT_EQ(red(0), 10);
        EXPECT_EQ(red(0.9999999f), 110);
        EXPECT_EQ(red(1), wrap == Wrap::Repeat ? 10 : 110);
        EXPECT_EQ(red(1.6f), wrap == Wrap::MirroredRepeat ? 10 : 110);
    }
}

TEST(EmbreeScene, StreamsAgreeWithSingleRays) {
    Soup soup;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto point = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 a = point();
        soup.add(a, a + 0.3f * point(), a + 0.3f * point(), i % 3 == 0 ? 1 : 0);
    }
    const EmbreeScene scene(soup.state);
    std::vector<Ray> rays(20001);
    for (Ray& ray : rays) ray = {point(), 0, point(), 1.0f + unit(random)};
    std::vector<Hit> hits(rays.size());
    std::vector<uint32_t> occluded(rays.size());
    scene.closestHit(rays, hits);
    scene.occluded(rays, occluded);
    size_t hitCount = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const Hit single = scene.closestHit(rays[i]);
        ASSERT_EQ(single.triangle, hits[i].triangle) << i;
        ASSERT_EQ(single.t, hits[i].t) << i;
        ASSERT_EQ(scene.occluded(rays[i]), occluded[i] == 1) << i;
        ASSERT_EQ(single.triangle != Hit::kMiss, occluded[i] == 1) << i;
        hitCount += occluded[i];
    }
    EXPECT_GT(hitCount, rays.size() / 20);

    // Packets of any size, some rays of which are not to be traced. Rounding differs
    for (size_t first = 0, count = 1; first + count <= rays.size();
         first += count, count = count % EmbreeScene::kPacketRays + 1) {
        if (count % 3 == 0) rays[first].tMax = -1.0f;
        const std::span<const Ray> packet = std::span(rays).subspan(first, count);
        std::array<Hit, EmbreeScene::kPacketRays> packetHits;
        std::array<uint32_t, EmbreeScene::kPacketRays> packetOccluded;
        scene.closestHitPacket(packet, std::span(packetHits).first(count));
        scene.occludedPacket(packet, std::span(packetOccluded).first(count));
        for (size_t i = 0; i < count; ++i) {
            const Hit single = scene.closestHit(packet[i]);
            ASSERT_EQ(single.triangle, packetHits[i].triangle) << first + i;
            ASSERT_NEAR(single.t, packetHits[i].t, 1e-5f) << first + i;
            ASSERT_EQ(scene.occluded(packet[i]), packetOccluded[i] == 1) << first + i;
        }
    }
}

TEST(EmbreeScene, StreamsNameTheFirstBadRay) {
    Soup soup;
    soup.add({0, 0, -5}, {4, 0, -5}, {0, 4, -5});
    const EmbreeScene scene(soup.state);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Ray good{{1, 1, 0}, 0, {0, 0, -1}, kInfinity};
    const std::vector<Ray> badRays{{{1, nan, 0}, 0, {0, 0, -1}, 1},     {{1, 1, 0}, 0, {0, kInfinity, -1}, 1},
                                   {{1, 1, 0}, nan, {0, 0, -1}, 1},     {{1, 1, 0}, 0, {0, 0, -1}, nan},
                                   {{1, 1, 0}, -1.0f, {0, 0, -1}, 1},   {{1, 1, 3e18f}, 0, {0, 0, -1}, 1},
                                   {{1, nan, 0}, 1.0f, {0, 0, -1}, -1}, {{1, 1, 0}, kInfinity, {0, 0, -1}, 1}};
    for (const Ray& bad : badRays) {
        std::vector<Ray> rays(30000, good);
        rays[12345] = rays[29000] = bad;
        std::vector<Hit> hits(rays.size());
        std::vector<uint32_t> occluded(rays.size());
        for (const Coherence coherence : {Coherence::Incoherent, Coherence::Coherent})
            for (const bool closest : {true, false}) {
                const std::string error = errorOf([&] {
                    closest ? scene.closestHit(rays, hits, coherence) : scene.occluded(rays, occluded, coherence);
                });
                EXPECT_CONTAINS(error, "ray 12345 ");
            }
    }
}

TEST(TextureLookup, WrapsAndFilters) {
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.rgba = {0, 0, 0, 255, 255, 255, 255, 255};
    EXPECT_FLOAT_EQ(sampleTexture(texture, {0.25f, 0.5f}).r, 0.0f);
    EXPECT_FLOAT_EQ(sampleTexture(texture, {0.75f, 0.5f}).r, 1.0f);
    EXPECT_FLOAT_EQ(sampleTexture(texture, {0.5f, 0.5f}).r, 0.5f);
    EXPECT_FLOAT_EQ(sampleTexture(texture, {-0.25f, 0.5f}).r, 1.0f);
    EXPECT_FLOAT_EQ(sampleTexture(texture, {1.0f, 0.5f}).r, 0.5f);
    texture.wrapU = Wrap::ClampToEdge;
    EXPECT_FLOAT_EQ(sampleTexture(texture, {-3.0f, 0.5f}).r, 0.0f);
    EXPECT_FLOAT_EQ(sampleTexture(texture, {1.0f, 0.5f}).r, 1.0f);
    texture.wrapU = Wrap::MirroredRepeat;
    EXPECT_FLOAT_EQ(sampleTexture(texture, {1.25f, 0.5f}).r, 1.0f);
    EXPECT_FLOAT_EQ(sampleTexture(texture, {1.75f, 0.5f}).r, 0.0f);
    EXPECT_FLOAT_EQ(sampleTexture(texture, {-0.75f, 0.5f}).r, 1.0f);
    EXPECT_TRUE(std::isfinite(sampleTexture(texture, {kInfinity, 1e38f}).r));
}

TEST(TextureLookup, DecodesSrgbBeforeFiltering) {
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.srgb = true;
    texture.rgba = {0, 188, 10, 0, 255, 188, 10, 255};
    const glm::vec4 center = sampleTexture(texture, {0.5f, 0.5f});
    EXPECT_FLOAT_EQ(center.r, 0.5f);
    EXPECT_NEAR(center.g, 0.5029f, 1e-4f);
    EXPECT_NEAR(center.b, 10.0f / 255.0f / 12.92f, 1e-6f);
    EXPECT_FLOAT_EQ(center.a, 0.5f);
}

}  // namespace
}  // namespace voxray
