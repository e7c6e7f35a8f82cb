// What a voxel holds of its surfaces' materials, for all three methods: factors, textures at the mip level of
// the voxel, normal maps, alpha masks, coverage.
#include <gtest/gtest.h>

#include <functional>

#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr const char* kMethods[] = {"exact", "dominant_axis", "three_axis"};
using Texel = std::array<uint8_t, 4>;

Texture texture(uint32_t size, const std::function<Texel(uint32_t x, uint32_t y)>& texel) {
    Texture t;
    t.width = t.height = size;
    for (uint32_t y = 0; y < size; ++y)
        for (uint32_t x = 0; x < size; ++x)
            for (const uint8_t channel : texel(x, y)) t.rgba.push_back(channel);
    t.wrapU = t.wrapV = Wrap::ClampToEdge;
    return t;
}

/// A square of 2 m in the plane z = 0 with texture coordinates 0 to 1, facing +z, of `material`; a thin strip
/// far behind it keeps the grid three-dimensional.
std::shared_ptr<const Scene> square(Material material, std::vector<Texture> textures) {
    SceneBuilder b("square");
    b.scene().textures = std::move(textures);
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.texCoords0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = b.material(std::move(material));
    b.place(b.mesh(mesh));
    b.quad("strip", {-1, -1, -1.05f}, {2, 0, 0}, {0, 0.1f, 0}, b.lambert("grey", glm::vec3(0.5f)));
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    return b.finish();
}

Material plain() {
    Material m;
    m.metallic = 0;
    m.specular = 0;
    m.roughness = 1;
    return m;
}

/// Visits the materials of the square's voxels that lie away from its edges.
void forSquare(const Voxels& voxels, const std::function<void(glm::vec3 center, const gpu::VoxelMaterial&)>& visit) {
    int seen = 0;
    voxels.forEach([&](glm::ivec3 v) {
        const glm::vec3 center = voxels.grid.origin + (glm::vec3(v) + 0.5f) * voxels.grid.voxelSize;
        if (!voxels.occupied(v) || std::abs(center.z) > voxels.grid.voxelSize) return;
        if (std::max(std::abs(center.x), std::abs(center.y)) > 1 - voxels.grid.voxelSize) return;
        if (voxels.at(v).area < 0.1f) return;
        visit(center, voxels.at(v));
        ++seen;
    });
    EXPECT_GT(seen, 30);
}

TEST(VoxelizeMaterial, HoldsMetallicAndRoughness) {
    Material m = plain();
    m.baseColor = {0.8f, 0.4f, 0.2f, 1};
    m.metallic = 0.25f;
    m.roughness = 0.6f;
    for (const std::string method : kMethods)
        forSquare(voxelize(square(m, {}), "resolution: 12, visibility_rays: 0, method: " + method),
                  [](glm::vec3, const gpu::VoxelMaterial& v) {
                      EXPECT_NEAR(v.metallic, 0.25, 1e-3);
                      EXPECT_NEAR(v.roughness, 0.6, 1e-3);
                      EXPECT_NEAR(v.albedo.x, 0.8 * 0.75, 1e-3);
                      EXPECT_NEAR(v.normal.z, 1, 1e-3);
                      EXPECT_EQ(v.opacity, 1.0f);
                  });
}

TEST(VoxelizeMaterial, ReadsTexturesAtTheVoxelsFootprint) {
    // A checkerboard of single texels, 21 of them along a voxel: every voxel sees grey.
    const Texture board = texture(256, [](uint32_t x, uint32_t y) {
        const uint8_t c = (x + y) % 2 ? 255 : 0;
        return Texel{c, c, c, 255};
    });
    Material m = plain();
    m.baseColorTexture.texture = 0;
    for (const std::string method : kMethods)
        forSquare(voxelize(square(m, {board}), "resolution: 12, visibility_rays: 0, method: " + method),
                  [](glm::vec3, const gpu::VoxelMaterial& v) { EXPECT_NEAR(v.albedo.x, 0.5, 0.01); });
}

TEST(VoxelizeMaterial, TexturesKeepTheirPlace) {
    // Red grows along x, green along y.
    const Texture ramp = texture(64, [](uint32_t x, uint32_t y) {
        return Texel{uint8_t(x * 4), uint8_t(y * 4), 0, 255};
    });
    Material m = plain();
    m.baseColorTexture.texture = 0;
    for (const std::string method : kMethods)
        forSquare(voxelize(square(m, {ramp}), "resolution: 16, visibility_rays: 0, method: " + method),
                  [&](glm::vec3 center, const gpu::VoxelMaterial& v) {
                      EXPECT_NEAR(v.albedo.x, 0.5 + 0.5 * center.x, 0.04) << method;
                      EXPECT_NEAR(v.albedo.y, 0.5 + 0.5 * center.y, 0.04) << method;
                  });
}

TEST(VoxelizeMaterial, NormalMapsTurnTheMeanNormalAndNoAreas) {
    // A map of one normal, (0.6, 0, 0.8).
    const Texture map = texture(4, [](uint32_t, uint32_t) { return Texel{204, 128, 230, 255}; });
    Material m = plain();
    m.normalTexture.texture = 0;
    for (const std::string method : kMethods)
        forSquare(voxelize(square(m, {map}), "resolution: 12, visibility_rays: 0, method: " + method),
                  [](glm::vec3, const gpu::VoxelMaterial& v) {
                      EXPECT_NEAR(v.normal.x, 0.6, 0.01);
                      EXPECT_NEAR(v.normal.z, 0.8, 0.01);
                      EXPECT_NEAR(v.unoccludedPositive.x, 0, 1e-4);
                      EXPECT_NEAR(v.unoccludedPositive.z, v.area, 1e-3);
                  });
}

TEST(VoxelizeMaterial, AlphaMasksLeaveHoles) {
    // The left half is cut away; in the right half stripes as wide as half a voxel are.
    const Texture stripes = texture(256, [](uint32_t x, uint32_t y) {
        return Texel{255, 255, 255, uint8_t(x >= 128 && y % 16 < 8 ? 255 : 0)};
    });
    Material m = plain();
    m.baseColorTexture.texture = 0;
    m.alphaMode = AlphaMode::Mask;
    for (const std::string method : kMethods) {
        const Voxels voxels = voxelize(
            square(m, {stripes}), "resolution: 16, visibility_rays: 0, samples_per_voxel_edge: 4, method: " + method);
        double area = 0, opacity = 0;
        int count = 0;
        voxels.forEach([&](glm::ivec3 v) {
            const glm::vec3 center = voxels.grid.origin + (glm::vec3(v) + 0.5f) * voxels.grid.voxelSize;
            if (!voxels.occupied(v) || std::abs(center.z) > voxels.grid.voxelSize) return;
            EXPECT_GT(center.x, -voxels.grid.voxelSize) << method;
            area += voxels.at(v).area;
            if (voxels.at(v).area < 0.1f) return;
            opacity += voxels.at(v).opacity;
            ++count;
        });
        // A quarter of 4 m².
        EXPECT_NEAR(area * voxels.grid.voxelSize * voxels.grid.voxelSize, 1.0, 0.06) << method;
        EXPECT_NEAR(opacity / count, 0.5, 0.12) << method;
    }
}

/// Voxelizes so many layers of the size of the grid, all in its one voxel: each has 9/16 of a face's area.
void voxelizeLayers(int count, const std::string& visibilityRays) {
    SceneBuilder b("layers");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    for (int i = 0; i < count; ++i)
        b.quad("layer", {-1, 0.5f * float(i) / float(count), -1}, {0, 0, 2}, {2, 0, 0}, grey);
    b.pointLight({0, 0.9f, 0}, glm::vec3(1));
    b.camera({0, 3, 3}, {0, 0, 0}, 60);
    Chain(evaluated(b), graphYaml({"voxelize, resolution: 1, visibility_rays: " + visibilityRays}), 4, 4);
}

TEST(VoxelizeMaterial, SumsThatOverflowAreRefused) {
    // Areas of 2047 faces are those of 3639 layers; 65,535 points, 256 a face, those of 455
    EXPECT_NO_THROW(voxelizeLayers(3600, "0"));
    EXPECT_ERROR("more than 2047 times the area of its face: raise 'resolution'", voxelizeLayers(3700, "0"));
    EXPECT_NO_THROW(voxelizeLayers(440, "256"));
    EXPECT_ERROR("more than 65535 visibility probes: raise 'resolution'", voxelizeLayers(480, "256"));
}

TEST(VoxelizeMaterial, OpacityIsTheFractionOfSubSamples) {
    // A square that covers the lower left quarter of one voxel, in a grid that a far speck makes 4 voxels
    // long.
    const float voxel = 1 / 3.75f;
    const glm::vec3 origin(0.5f - 2 * voxel);
    const auto at = [&](float x, float y, float z) { return origin + voxel * glm::vec3(x, y, z); };
    std::vector<glm::vec3> corners{at(1, 1, 1.5f), at(1.5f, 1, 1.5f),    at(1.5f, 1.5f, 1.5f),
                                   at(1, 1, 1.5f), at(1.5f, 1.5f, 1.5f), at(1, 1.5f, 1.5f)};
    for (const glm::vec3 end : {glm::vec3(0.0f), glm::vec3(1.0f)})
        for (const glm::vec3 step : {glm::vec3(0.0f), glm::vec3(0.01f, 0, 0), glm::vec3(0, 0.01f, 0)})
            corners.push_back(glm::clamp(end + (end.x > 0.5f ? -step : step), 0.0f, 1.0f));
    for (const std::string method : {"exact", "dominant_axis"}) {
        const Voxels voxels = voxelize(triangleScene(corners), "resolution: 4, visibility_rays: 0, method: " + method);
        ASSERT_TRUE(voxels.occupied({1, 1, 1})) << method;
        EXPECT_EQ(voxels.at({1, 1, 1}).opacity, 0.25f) << method;
        EXPECT_NEAR(voxels.at({1, 1, 1}).area, 0.25, 1e-3) << method;
    }
}

}  // namespace
}  // namespace voxray::test
