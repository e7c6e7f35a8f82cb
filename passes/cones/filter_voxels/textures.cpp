#include <algorithm>
#include <bit>

#include "passes/cones/filter_voxels/full_grids.h"
#include "passes/cones/radiance/radiance_texture.h"
#include "passes/cones/radiance/radiance_types.h"

namespace voxray {
namespace {

/// The buffer `radianceVoxels` of passes/cones/radiance/radiance_textures.glsl.
struct TextureHeader {
    gpu::RadianceGrid grid;
    gpu::TextureLayout layout;
};

gpu::TextureLayout textureLayout(glm::uvec3 resolution) {
    gpu::TextureLayout layout{};
    for (int axis = 0; axis < 3; ++axis) layout.extent[axis] = std::bit_ceil(resolution[axis]);
    const int longest = resolution.x >= std::max(resolution.y, resolution.z) ? 0 : resolution.y >= resolution.z ? 1 : 2;
    layout.along[longest] = 1;
    layout.extent.z = std::max(layout.extent.z, 2u);  // An image one texel deep would be 2D.
    return layout;
}

/// Full grids as mip levels of a 3D texture, filtered by the device as Arnebäck 2017 does. Docs:
/// docs/cone-tracing.md.
class TexturesStorage final : public FullGrids {
 public:
    using FullGrids::FullGrids;

    void plan(PassPlan& plan, const SurfaceVoxels&, RadianceVoxels& radiance) override {
        const gpu::RadianceGrid& grid = radiance.grid;
        layout_ = textureLayout(grid.resolution);
        planRadianceTexture(plan, "filter_voxels", "set 'layout' to dense",
                            layout_.extent * (1u + (grid.directions - 1u) * layout_.along), grid.levels, radiance);
        plan.buffer(radiance.header, "radiance voxels' header", sizeof(TextureHeader));
        define(radiance);
    }

    void prepare(PassSetup& setup, RadianceVoxels& radiance) override {
        const TextureHeader header{radiance.grid, layout_};
        setup.stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));
        prepareRadianceTexture(setup, radiance);
    }

 private:
    gpu::TextureLayout layout_{};
};

}  // namespace

std::unique_ptr<RadianceStorage> makeTexturesStorage(ProgramOwner& owner) {
    return std::make_unique<TexturesStorage>(owner);
}

}  // namespace voxray
