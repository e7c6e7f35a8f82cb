// The g-buffer: rays and raster see the same, and sub-pixels bring edges to the path tracer's pixel means.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>

#include "experiment/pixel_masks.h"
#include "image/metrics.h"
#include "passes/common/view/gbuffer.h"
#include "scene/region_split.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

const GBuffer& gbuffer(const Chain& chain) {
    return chain.get<GBuffer>("gbuffer");
}

std::vector<glm::vec4> texels(Chain& chain, const Image& image) {
    std::vector<glm::vec4> out;
    if (image.desc().format == VK_FORMAT_R16G16B16A16_SFLOAT)
        for (const uint64_t packed : chain.readImage<uint64_t>(image)) out.push_back(glm::unpackHalf4x16(packed));
    else if (image.desc().format == VK_FORMAT_R8G8B8A8_UNORM)
        for (const uint32_t packed : chain.readImage<uint32_t>(image)) out.push_back(glm::unpackUnorm4x8(packed));
    else
        for (const glm::vec4& texel : chain.readImage<glm::vec4>(image)) out.push_back(texel);
    return out;
}

// Whether one surface fills a pixel and its neighbors: their normals agree.
bool isSmooth(const std::vector<glm::vec4>& normals, int x, int y, int width, int height) {
    const glm::vec4 own = normals[size_t(y * width + x)];
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
            if (glm::dot(own, normals[size_t(v * width + u)]) < 0.9f) return false;
    return true;
}

void expectSameView(const std::string& scene, const std::string& parameters, float sceneSize) {
    constexpr int kWidth = 96, kHeight = 64;
    Chain rays(scene, parameters, graphYaml({"gbuffer, method: rays"}), kWidth, kHeight);
    Chain raster(scene, parameters, graphYaml({"gbuffer, method: raster"}), kWidth, kHeight);
    const GBuffer &a = gbuffer(rays), &b = gbuffer(raster);
    const auto normalA = texels(rays, a.geometricNormal), normalB = texels(raster, b.geometricNormal);
    const auto shadingA = texels(rays, a.normal), shadingB = texels(raster, b.normal);
    const auto positionA = texels(rays, a.position), positionB = texels(raster, b.position);
    const auto albedoA = texels(rays, a.albedo), albedoB = texels(raster, b.albedo);
    const auto emissionA = texels(rays, a.emission), emissionB = texels(raster, b.emission);
    const auto specularA = texels(rays, a.specular), specularB = texels(raster, b.specular);
    const auto fresnelA = texels(rays, a.fresnel), fresnelB = texels(raster, b.fresnel);
    int smooth = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const auto i = size_t(y * kWidth + x);

            // Silhouettes may differ by which side of an edge a sample falls on, but no pixel sees a
            // surface's back.
            if (!isSmooth(normalA, x, y, kWidth, kHeight)) continue;
            ++smooth;
            ASSERT_LT(glm::length(positionA[i] - positionB[i]), 1e-3f * sceneSize) << scene << " " << x << " " << y;
            ASSERT_LT(glm::length(normalA[i] - normalB[i]), 2e-3f) << scene << " " << x << " " << y;
            ASSERT_LT(glm::length(shadingA[i] - shadingB[i]), 5e-3f) << scene << " " << x << " " << y;
            ASSERT_LT(glm::length(albedoA[i] - albedoB[i]), 2e-3f) << scene << " " << x << " " << y;
            ASSERT_LT(glm::length(specularA[i] - specularB[i]), 2e-3f) << scene << " " << x << " " << y;
            ASSERT_EQ(fresnelA[i], fresnelB[i]) << scene << " " << x << " " << y;
            ASSERT_LT(glm::length(emissionA[i] - emissionB[i]), 1e-3f) << scene << " " << x << " " << y;
        }
    EXPECT_GT(smooth, kWidth * kHeight / 4) << scene;
}

TEST(GBuffer, RaysAndRasterSeeTheSame) {
    expectSameView("cornell", "{lights: area}", 2.0f);
    expectSameView("spheres", "{}", 10.0f);
    expectSameView("mirror_room", "{}", 4.0f);
}

// An edge along columns that crosses pixels at any place: a rotated grid of n² samples covers in steps of 1/n², a
// regular one in steps of 1/n.
TEST(GBuffer, SamplesOfARotatedGridCoverStraightEdgesInFineSteps) {
    const auto largestError = [](const std::string& pattern, bool isRow) {
        float largest = 0;
        for (int step = 0; step < 16; ++step) {
            // At z = 0 the view is 2 m wide: a pixel of four covers 0.5 m
            const float covered = (float(step) + 0.5f) / 16, edge = 0.5f * covered;
            SceneBuilder builder("edge");
            const glm::vec3 size = isRow ? glm::vec3(2, 1 + edge, 0) : glm::vec3(1 + edge, 2, 0);
            builder.quad("sheet", {-1, -1, 0}, {size.x, 0, 0}, {0, size.y, 0}, builder.lambert("white", glm::vec3(1)));
            builder.camera({0, 0, 1}, {0, 0, 0}, 90);
            Chain chain(evaluated(builder),
                        graphYaml({"gbuffer, samples_per_pixel_edge: 4, sample_pattern: " + pattern}), 4, 4);
            const auto albedo = texels(chain, gbuffer(chain).albedo);
            float sum = 0;  // Of the pixel that the edge crosses.
            for (size_t i = 0; i < 16; ++i) {
                const size_t x = (isRow ? 4u : 8u) + i % 4, y = (isRow ? 4u : 8u) + i / 4;
                sum += albedo[y * 16 + x].w;
            }
            largest = std::max(largest, std::abs(sum / 16 - covered));
        }
        return largest;
    };
    for (const bool isRow : {false, true}) {
        EXPECT_LT(largestError("rotated", isRow), 0.5f / 16 + 1e-3f);
        EXPECT_GT(largestError("regular", isRow), 0.09f);
    }
}

// The same edge, whose place no grid of four samples resolves: random samples cover as much of its pixel as it does in
// the mean over frames, by one point in each cell of the grid.
TEST(GBuffer, RandomSamplesCoverAnEdgeInTheMeanOverFrames) {
    const float covered = 0.3f;
    SceneBuilder builder("edge");
    builder.quad("sheet", {-1, -1, 0}, {1 + 0.5f * covered, 0, 0}, {0, 2, 0}, builder.lambert("white", glm::vec3(1)));
    builder.camera({0, 0, 1}, {0, 0, 0}, 90);
    const State state = evaluated(builder);
    const auto errorOf = [&](const std::string& pattern, uint32_t frames) {
        Chain chain(state, graphYaml({"gbuffer, samples_per_pixel_edge: 2, sample_pattern: " + pattern}), 4, 4);
        double sum = 0;  // Of the column of pixels that the edge crosses.
        for (uint32_t frame = 1; frame <= frames; ++frame) {
            chain.runFrame(frame);
            const auto albedo = texels(chain, gbuffer(chain).albedo), position = texels(chain, gbuffer(chain).position);
            for (size_t y = 0; y < 8; ++y)
                for (size_t x = 4; x < 6; ++x) {
                    const size_t i = y * 8 + x;
                    sum += albedo[i].w;
                    if (albedo[i].w > 0) {
                        EXPECT_EQ(std::floor((position[i].x + 1) * 4), x) << pattern;
                    }
                }
        }
        return sum / (16.0 * frames) - covered;
    };
    // Only samples of the left half of the pixels see the edge
    const uint32_t frames = 100;
    EXPECT_NEAR(errorOf("random", frames), 0, 4 * 0.5 * std::sqrt(0.6 * 0.4 / (8 * frames)));
    EXPECT_GT(std::abs(errorOf("regular", 2)), 0.1);
}

// With materials of surfaces every sample keeps its point. A pixel that shows several surfaces is as with materials of
// samples; the texels of another one have one normal, close to all of theirs.
TEST(GBuffer, MaterialsOfSurfacesKeepPointsAndEdges) {
    constexpr size_t kWidth = 64, kHeight = 48;
    for (const std::string samples : {"2", "3"}) {
        SCOPED_TRACE(samples);
        const size_t n = std::stoul(samples);
        const std::string pass = "gbuffer, samples_per_pixel_edge: " + samples;
        Chain each("spheres", "{}", graphYaml({pass}), kWidth, kHeight);
        Chain shared("spheres", "{}", graphYaml({pass + ", materials_of: surfaces"}), kWidth, kHeight);
        const GBuffer &a = gbuffer(each), &b = gbuffer(shared);
        const auto positionA = texels(each, a.position), positionB = texels(shared, b.position);
        const auto normalA = texels(each, a.normal), normalB = texels(shared, b.normal);
        const auto albedoA = texels(each, a.albedo), albedoB = texels(shared, b.albedo);
        const auto emissionA = texels(each, a.emission), emissionB = texels(shared, b.emission);
        size_t several = 0;
        for (size_t y = 0; y < n * kHeight; ++y)
            for (size_t x = 0; x < n * kWidth; ++x) {
                const size_t i = y * n * kWidth + x, corner = (y - y % n) * n * kWidth + x - x % n;
                ASSERT_LT(glm::length(positionA[i] - positionB[i]), 1e-5f) << x << " " << y;
                ASSERT_EQ(normalB[i], normalB[corner].w > 0 ? normalB[corner] : normalA[i]) << x << " " << y;
                if (normalB[i].w == 0) {
                    ++several;
                    ASSERT_EQ(albedoA[i], albedoB[i]) << x << " " << y;
                    ASSERT_EQ(emissionA[i], emissionB[i]) << x << " " << y;
                } else {
                    ASSERT_GT(glm::dot(glm::vec3(normalA[i]), glm::vec3(normalB[i])), std::cos(glm::radians(9.0f)));
                    ASSERT_LT(glm::length(albedoA[i] - albedoB[i]), 1e-3f) << x << " " << y;
                }
            }
        EXPECT_GT(several, n * n * kWidth);
        EXPECT_LT(several, n * n * kWidth * kHeight / 2);
    }
    EXPECT_ERROR("'materials_of: samples'",
                 Chain("spheres", "{}",
                       graphYaml({"gbuffer, samples_per_pixel_edge: 2, materials_of: surfaces, normal_maps: sharp"})));
}

TEST(GBuffer, SpecularReflectanceFollowsTheMaterial) {
    // A tinted dielectric: F0 = colour * specular * ((n - 1) / (n + 1))², at most specular.
    SceneBuilder builder("pane");
    Material m;
    m.baseColor = glm::vec4(0.5f, 0.4f, 0.3f, 1.0f);
    m.metallic = 0;
    m.roughness = 0.25f;
    m.specular = 0.8f;
    m.specularColor = glm::vec3(1, 0.5f, 0);
    m.ior = 3.0f;
    builder.quad("pane", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, builder.material(m));
    builder.camera({0, 0, 1}, {0, 0, 0}, 40);
    Chain chain(evaluated(builder), graphYaml({"gbuffer"}), 4, 4);
    for (const glm::vec4& s : texels(chain, gbuffer(chain).specular))
        EXPECT_LT(glm::length(s - glm::vec4(0.2f, 0.1f, 0, 0.25f)), 1e-3f);
    for (const glm::vec4& f : texels(chain, gbuffer(chain).fresnel))
        EXPECT_LT(glm::length(f - glm::vec4(0.8f, 0.2f, 0.8f, 0)), 4e-3f);
}

TEST(GBuffer, SurfacesWithoutASpecularLobeHaveNoRoughness) {
    // The second material makes the scene one with lobes, whose texels are stored in each frame
    for (const float specular : {0.0f, 1.0f}) {
        SceneBuilder builder("two panes");
        Material lambert;
        lambert.metallic = 0;
        lambert.roughness = 0.25f;
        lambert.specular = 0;
        Material glossy = lambert;
        glossy.specular = specular;
        builder.quad("left", {-2, -1, 0}, {2, 0, 0}, {0, 2, 0}, builder.material(lambert));
        builder.quad("right", {0, -1, 0}, {2, 0, 0}, {0, 2, 0}, builder.material(glossy));
        builder.camera({0, 0, 1}, {0, 0, 0}, 40);
        const auto state = evaluated(builder);
        for (const std::string pass : {"gbuffer", "gbuffer, method: raster"}) {
            Chain chain(state, graphYaml({pass}), 4, 4);
            const std::vector<glm::vec4> found = texels(chain, gbuffer(chain).specular);
            for (size_t i = 0; i < found.size(); ++i)
                EXPECT_NEAR(found[i].a, i % 4 < 2 || specular == 0 ? 0.0f : 0.25f, 1e-3f) << pass << " " << i;
        }
    }
}

TEST(GBuffer, NoTexelSeesABodyFromInside) {
    // A box glows outwards only; where it is seen at all, it glows, silhouettes included.
    for (const std::string method : {"rays", "raster"}) {
        int seen = 0, dark = 0;
        for (int turn = 0; turn < 6; ++turn) {
            SceneBuilder builder("box");
            const uint32_t glowing = builder.lambert("glowing", glm::vec3(0.5f), glm::vec3(1.0f));
            builder.box("box", {0, 0, 0}, {1, 1, 1}, 0.1f + 0.25f * float(turn), glowing);
            builder.camera({0, 2, 4}, {0, 0.5f, 0}, 25);
            Chain chain(evaluated(builder), graphYaml({"gbuffer, samples_per_pixel_edge: 4, method: " + method}), 96,
                        96);
            const auto emission = texels(chain, gbuffer(chain).emission);
            const auto positions = chain.readImage<glm::vec4>(gbuffer(chain).position);
            for (size_t i = 0; i < positions.size(); ++i) {
                seen += positions[i].w > 0;
                dark += positions[i].w > 0 && emission[i].x == 0;
            }
        }
        EXPECT_GT(seen, 100000) << method;
        EXPECT_EQ(dark, 0) << method;
    }
}

// A square of 1 m with a texture of columns, black and white in turn.
State stripes(uint32_t columns, const glm::vec3& eye) {
    SceneBuilder builder("stripes");
    Scene& scene = builder.scene();
    Texture texture{"stripes", columns, columns, {}, false, Wrap::Repeat, Wrap::Repeat};
    for (uint32_t i = 0; i < columns * columns; ++i)
        for (int c = 0; c < 4; ++c) texture.rgba.push_back(c == 3 || i % 2 ? 255 : 0);
    scene.textures.push_back(texture);
    builder.quad("square", {-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}, builder.lambert("stripes", glm::vec3(1)));
    scene.meshes.back().texCoords0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.materials.back().baseColorTexture.texture = 0;
    builder.camera(eye, {0, 0, 0}, 30);
    return evaluated(builder);
}

TEST(GBuffer, TheNearerOfTwoSheetsIsSeenHoweverFarOtherSurfacesLie) {
    SceneBuilder builder("sheets");
    builder.quad("front", {-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, builder.lambert("front", glm::vec3(0.8f)));
    builder.quad("back", {-3, -3, -1e-4f}, {6, 0, 0}, {0, 6, 0}, builder.lambert("back", glm::vec3(0.2f)));
    builder.quad("stray", {1e6f, 0, 0}, {1, 0, 0}, {0, 1, 0}, builder.lambert("stray", glm::vec3(0.5f)));
    builder.camera({0, 0, 4}, {0, 0, 0}, 60);
    const auto state =
        std::make_shared<SceneState>(splitAtRegion(evaluate(builder.finish(), 0), {{-3, -3, -1}, {3, 3, 4}}, 0));
    for (const std::string method : {"rays", "raster"}) {
        Chain chain(state, graphYaml({"gbuffer, method: " + method}), 16, 16);
        for (const glm::vec4& albedo : texels(chain, gbuffer(chain).albedo))
            EXPECT_NEAR(albedo.x, 0.8f, 0.01f) << method;
    }
}

TEST(GBuffer, TexturesAreSeenAtTheFootprintOfAPixel) {
    // 32 pixels over about 0.54 m: 1024 columns on a metre are 17 a pixel and blur to grey, 16 stay black and
    // white.
    const auto graph = [](const std::string& method) { return graphYaml({"gbuffer, method: " + method}); };
    for (const std::string method : {"rays", "raster"}) {
        Chain fine(stripes(1024, {0, 0, 1}), graph(method), 32, 32);
        for (const glm::vec4& albedo : texels(fine, gbuffer(fine).albedo)) EXPECT_NEAR(albedo.x, 0.5f, 0.01f);
        Chain coarse(stripes(16, {0, 0, 1}), graph(method), 32, 32);
        const auto albedos = texels(coarse, gbuffer(coarse).albedo);
        const auto [low, high] = std::minmax_element(albedos.begin(), albedos.end(),
                                                     [](const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; });
        EXPECT_LT(low->x, 0.05f);
        EXPECT_GT(high->x, 0.95f);
    }
}

// A white texture with a black last column covers the left half of the square, which goes on in black: mip
// levels where that column is 1 in 32 do not make it grey.
TEST(GBuffer, OutsideOfAClampedTextureIsItsEdge) {
    for (const std::string method : {"rays", "raster"}) {
        const auto state = std::make_shared<SceneState>(*stripes(1024, {0, 0, 1}));
        auto scene = std::make_shared<Scene>(*state->scene);
        Texture& texture = scene->textures[0];
        texture.wrapU = texture.wrapV = Wrap::ClampToEdge;
        for (size_t i = 0; i < texture.rgba.size(); ++i) texture.rgba[i] = i % 4 == 3 || i / 4 % 1024 < 1023 ? 255 : 0;
        state->scene = scene;
        for (VertexAttributes& vertex : state->geometry.attributes) vertex.texCoords.x *= 2;
        Chain chain(state, graphYaml({"gbuffer, method: " + method}), 32, 32);
        const auto albedos = texels(chain, gbuffer(chain).albedo);
        for (uint32_t i = 0; i < albedos.size(); ++i) {
            const uint32_t column = i % 32;
            if (column >= 14 && column <= 17) continue;
            ASSERT_NEAR(albedos[i].x, column < 14 ? 1 : 0, 0.001) << method << " " << i;
        }
    }
}

TEST(GBuffer, ANearestTextureHasNoColorBetweenItsTexels) {
    for (const std::string method : {"rays", "raster"}) {
        const auto state = std::make_shared<SceneState>(*stripes(2, {0, 0, 1}));
        auto scene = std::make_shared<Scene>(*state->scene);
        scene->textures[0].filter = TexelFilter::Nearest;
        state->scene = scene;
        Chain chain(state, graphYaml({"gbuffer, method: " + method}), 32, 32);
        const auto albedos = texels(chain, gbuffer(chain).albedo);
        // Half floats round 1 off by 0.0005.
        const auto isBlack = [](const glm::vec4& albedo) { return albedo.x == 0; };
        const auto isWhite = [](const glm::vec4& albedo) { return albedo.x > 0.999f; };
        EXPECT_EQ(std::ranges::count_if(albedos, isBlack), 512) << method;
        EXPECT_EQ(std::ranges::count_if(albedos, isWhite), 512) << method;
    }
}

TEST(GBuffer, SharpColorsAreThoseAtThePoint) {
    // 1024 columns on a metre are 17 a pixel; so each pixel sees some column, and not their mean.
    for (const std::string method : {"rays", "raster"}) {
        Chain chain(stripes(1024, {0, 0, 1}), graphYaml({"gbuffer, colors: sharp, method: " + method}), 32, 32);
        const auto albedos = texels(chain, gbuffer(chain).albedo);
        const auto [low, high] = std::minmax_element(albedos.begin(), albedos.end(),
                                                     [](const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; });
        EXPECT_LT(low->x, 0.1f) << method;
        EXPECT_GT(high->x, 0.9f) << method;
    }
}

TEST(GBuffer, AovsAgreeWithWhatTheHostSees) {
    // Depth and numbers in the files of --aovs are the host's, positions and albedo the pass's own.
    Chain chain("cornell", "{lights: point}", "[{pass: gbuffer, samples_per_pixel_edge: 2}]", 48, 32);
    const std::vector<Aov> aovs = gbuffer(chain).aovs();
    ASSERT_EQ(aovs.at(0).channels, (std::vector<std::string>{"P.X", "P.Y", "P.Z"}));
    ASSERT_EQ(aovs.at(3).channels.at(0), "albedo.R");
    const auto positions = texels(chain, *aovs[0].image), albedos = texels(chain, *aovs[3].image);
    const Camera& camera = chain.state().cameras.at(0);
    const std::vector<PrimaryHit> hits = primaryHits(chain.state(), camera, 96, 64);
    ASSERT_EQ(positions.size(), hits.size());
    size_t surfaces = 0, differing = 0;  // Rays that meet an edge may fall on either side of it.
    for (size_t i = 0; i < hits.size(); ++i) {
        const bool isSurface = positions[i].w > 0;
        const float depth = glm::dot(glm::vec3(positions[i]) - camera.position, camera.forward);
        surfaces += isSurface;
        if (isSurface != (hits[i].instance >= 0) || (isSurface && std::abs(depth - hits[i].depth) > 1e-3f)) {
            ++differing;
            continue;
        }
        if (!isSurface) continue;
        const Material& material = chain.state().scene->materials.at(size_t(hits[i].material));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(albedos[i][c], material.baseColor[c], 1e-3f) << i;
    }
    EXPECT_GT(surfaces, hits.size() / 2);
    EXPECT_LT(surfaces, hits.size());
    EXPECT_LT(differing, hits.size() / 200);
}

TEST(GBuffer, SubPixelsApproachPixelMeans) {
    const auto direct = [](const std::string& samples, const std::string& method) {
        Chain chain("cornell", "{lights: point}",
                    graphYaml({"gbuffer, samples_per_pixel_edge: " + samples + ", method: " + method,
                               "direct_shadow_rays", "composite"}),
                    48, 48);
        return chain.image("final");
    };
    Chain reference("cornell", "{lights: point}", graphYaml({"path_trace, spp: 256, bounces: 0"}), 48, 48);
    const ImageF truth = reference.image("final");
    const ImageF one = direct("1", "rays"), four = direct("4", "rays"), raster = direct("4", "raster");
    EXPECT_LT(nRmse(four, truth), 0.15 * nRmse(one, truth));
    EXPECT_NEAR(mean(four) / mean(truth), 1.0, 0.005);
    EXPECT_LT(nRmse(raster, truth), 0.15 * nRmse(one, truth));
}

}  // namespace
}  // namespace voxray::test
