#include <algorithm>
#include <bit>

#include "base/error.h"
#include "passes/filter_voxels/dense_fill.h"
#include "shaders/radiance/radiance_textures_types.h"

namespace voxray {
namespace {

/// The buffer `radianceVoxels` of shaders/radiance/radiance_textures.glsl.
struct Header {
    gpu::RadianceGrid grid;
    gpu::TextureLayout layout;
};

gpu::TextureLayout layoutOf(glm::uvec3 resolution) {
    gpu::TextureLayout layout{};
    for (int axis = 0; axis < 3; ++axis) layout.extent[axis] = std::bit_ceil(resolution[axis]);
    const int longest = resolution.x >= std::max(resolution.y, resolution.z) ? 0
                        : resolution.y >= resolution.z                       ? 1
                                                                             : 2;
    layout.along[longest] = 1;
    layout.extent.z = std::max(layout.extent.z, 2u);  // An image one texel deep would be 2D.
    return layout;
}

/// Full grids as mip levels of a 3D texture, filtered by the device as Arnebäck 2017 does. Docs:
/// docs/cone-tracing.md.
class TexturesStorage final : public RadianceStorage {
 public:
    void plan(PassPlan& plan, const SurfaceVoxels&, RadianceVoxels& radiance) override {
        const gpu::RadianceGrid& grid = radiance.grid;
        layout_ = layoutOf(grid.resolution);
        ImageDesc desc;
        desc.format = VK_FORMAT_R16G16B16A16_SFLOAT;
        desc.extent = layout_.extent * (1u + (grid.directions - 1u) * layout_.along);
        desc.mipLevels = grid.levels;
        const uint32_t largest = plan.device.filteredVolumeSide;
        if (largest == 0)
            throw Error(
                "filter_voxels: device '{}' can't store to and filter 3D images of half floats "
                "(R16G16B16A16_SFLOAT, storage image and linear filter); set 'layout' to dense",
                plan.device.name);
        if (std::max({desc.extent.x, desc.extent.y, desc.extent.z}) > largest)
            throw Error(
                "filter_voxels: the 3D texture has {}x{}x{} texels, device '{}' takes at most {} along an "
                "axis "
                "(maxImageDimension3D); lower voxelize's 'resolution' or 'directions', or set 'layout' to "
                "dense",
                desc.extent.x, desc.extent.y, desc.extent.z, plan.device.name, largest);
        plan.image(radiance.texture, "radiance voxels", desc);
        plan.buffer(radiance.header, "radiance voxels' header", sizeof(Header));
    }

    void prepare(PassSetup& setup, RadianceVoxels& radiance) override {
        const Header header{radiance.grid, layout_};
        setup.stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));
        // Filtering reads texels round the grid's with a weight of 0.
        setup.stream.clear(radiance.texture, {});
        radiance.sampler = Sampler(setup.device, Filter::Linear, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
        fill_ = DenseFill(setup, radiance);
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
             RadianceVoxels& radiance, float emission) override {
        fill_.run(context.stream, voxels, light, radiance, emission);
    }

 private:
    gpu::TextureLayout layout_{};
    DenseFill fill_;
};

}  // namespace

std::unique_ptr<RadianceStorage> makeTexturesStorage() {
    return std::make_unique<TexturesStorage>();
}

}  // namespace voxray
