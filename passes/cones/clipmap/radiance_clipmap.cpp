#include "passes/cones/clipmap/radiance_clipmap.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "passes/cones/clipmap/clipmap_atlas.h"
#include "passes/cones/radiance/radiance_texture.h"

namespace voxray {
namespace {

constexpr uint32_t kClipmapValueBytes = 8;  // passes/cones/radiance/radiance_texel.glsl

/// The buffer `radianceVoxels` of passes/cones/radiance/radiance_clipmap.glsl, without what the storage adds.
struct ClipmapHeader {
    gpu::RadianceGrid grid;
    uint32_t windowSize;
    uint32_t firstWhole;
    std::array<gpu::ClipmapWindow, RADIANCE_CLIPMAP_LEVELS> windows;
};
static_assert(sizeof(ClipmapHeader) % sizeof(uint64_t) == 0);

/// Added by radiance_clipmap_textures.glsl.
struct ClipmapTextureHeader {
    glm::uvec3 extent;
    std::array<glm::uvec3, RADIANCE_CLIPMAP_LEVELS> blocks;
};

}  // namespace

void RadianceClipmap::plan(PassPlan& plan, const std::string& pass, RadianceVoxels& radiance,
                           const std::string& remedy) const {
    const gpu::RadianceGrid& grid = radiance.grid;
    if (radiance.layout == RadianceLayout::ClipmapTextures) {
        const glm::uvec3 extent = packAtlas(windows_, grid.levels, grid.directions).extent;
        planRadianceTexture(plan, pass, remedy, extent, 1, radiance);
        plan.buffer(radiance.header, "radiance clipmap's header", sizeof(ClipmapHeader) + sizeof(ClipmapTextureHeader));
        return;
    }
    radiance.grid.unit = 1;
    const uint64_t values = windows_.voxels() * grid.directions;
    if (values > UINT32_MAX)
        throw Error("{}: {} values can't be numbered in 32 bits; lower clipmap_resolution", pass, values);
    radiance.storage = std::vector<Buffer>(1);
    plan.buffer(radiance.storage[0], "radiance clipmap", values * kClipmapValueBytes);
    plan.buffer(radiance.header, "radiance clipmap's header", sizeof(ClipmapHeader) + sizeof(uint64_t));
}

void RadianceClipmap::prepare(PassSetup& setup, RadianceVoxels& radiance) const {
    const auto upload = [&](const auto& added) {
        setup.stream.upload(radiance.header, std::as_bytes(std::span(&added, 1)), sizeof(ClipmapHeader));
    };
    if (radiance.layout != RadianceLayout::ClipmapTextures) {
        upload(radiance.storage[0].address());
        return;
    }
    const ClipmapAtlas atlas = packAtlas(windows_, radiance.grid.levels, radiance.grid.directions);
    ClipmapTextureHeader added{atlas.extent, {}};
    std::ranges::copy(atlas.blocks, added.blocks.begin());
    upload(added);
    prepareRadianceTexture(setup, radiance);
}

std::vector<gpu::ClipmapWindow> RadianceClipmap::moveWindows(PassContext& context, RadianceVoxels& radiance) const {
    const glm::vec3 camera = context.frame.camera.position;
    std::vector<gpu::ClipmapWindow> windows;
    for (uint32_t level = 0; level < radiance.grid.levels; ++level) windows.push_back(windows_.window(level, camera));
    if (radiance.euclidean)
        for (gpu::ClipmapWindow& w : windows) {
            w.center = camera;
            w.reach = glm::vec3(std::min({w.reach.x, w.reach.y, w.reach.z}));
        }
    ClipmapHeader header{radiance.grid, windows_.windowSize(), windows_.firstWhole(), {}};
    std::ranges::copy(windows, header.windows.begin());
    context.stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));
    return windows;
}

}  // namespace voxray
