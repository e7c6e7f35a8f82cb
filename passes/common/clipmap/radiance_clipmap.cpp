#include "passes/common/clipmap/radiance_clipmap.h"

#include <algorithm>
#include <array>

#include "base/error.h"

namespace voxray {
namespace {

constexpr uint32_t kValueBytes = 8;  // shaders/radiance/radiance_texel.glsl

/// The buffer `radianceVoxels` of shaders/radiance/radiance_clipmap.glsl.
struct Header {
    gpu::RadianceGrid grid;
    uint64_t values;
    uint32_t side;
    uint32_t firstWhole;
    std::array<gpu::ClipmapWindow, RADIANCE_CLIPMAP_LEVELS> windows;
};
static_assert(sizeof(gpu::RadianceGrid) % 8 == 0);

}  // namespace

void RadianceClipmap::plan(PassPlan& plan, const std::string& pass, RadianceVoxels& radiance) const {
    radiance.grid.unit = 1;
    const uint64_t values = windows_.voxels() * radiance.grid.directions;
    if (values > UINT32_MAX)
        throw Error("{}: {} values can't be numbered in 32 bits; lower clipmap_resolution", pass, values);
    radiance.storage = std::vector<Buffer>(1);
    plan.buffer(radiance.storage[0], "radiance clipmap", values * kValueBytes);
    plan.buffer(radiance.header, "radiance clipmap's header", sizeof(Header));
}

std::vector<gpu::ClipmapWindow> RadianceClipmap::follow(PassContext& context,
                                                        RadianceVoxels& radiance) const {
    const glm::vec3 camera = context.frame.camera.position;
    std::vector<gpu::ClipmapWindow> windows;
    for (uint32_t level = 0; level < radiance.grid.levels; ++level)
        windows.push_back(windows_.window(level, camera));
    if (radiance.euclidean)
        for (gpu::ClipmapWindow& w : windows) {
            w.center = camera;
            w.reach = glm::vec3(std::min({w.reach.x, w.reach.y, w.reach.z}));
        }
    Header header{radiance.grid, radiance.storage[0].address(), windows_.side(), windows_.firstWhole(), {}};
    std::ranges::copy(windows, header.windows.begin());
    context.stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));
    return windows;
}

}  // namespace voxray
