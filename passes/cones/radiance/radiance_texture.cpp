#include "passes/cones/radiance/radiance_texture.h"

#include <algorithm>

#include "base/error.h"

namespace voxray {

void planRadianceTexture(PassPlan& plan, const std::string& pass, const std::string& remedy, glm::uvec3 extent,
                         uint32_t mipLevels, RadianceVoxels& radiance) {
    const uint32_t largest = plan.device.filteredVolumeSide;
    if (largest == 0)
        throw Error(
            "{}: device '{}' can't store to and filter 3D images of half floats (R16G16B16A16_SFLOAT, "
            "storage image and linear filter); {}",
            pass, plan.device.name, remedy);
    if (std::max({extent.x, extent.y, extent.z}) > largest)
        throw Error(
            "{}: "
            "the 3D texture has {}x{}x{} texels, device '{}' takes at most {} along an axis (maxImageDimension3D); "
            "lower the voxels' resolution or 'directions', or {}",
            pass, extent.x, extent.y, extent.z, plan.device.name, largest, remedy);
    ImageDesc desc;
    desc.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    desc.extent = extent;
    desc.mipLevels = mipLevels;
    plan.image(radiance.texture, "radiance voxels", desc);
}

void prepareRadianceTexture(PassSetup& setup, RadianceVoxels& radiance) {
    setup.stream.clear(radiance.texture, {});
    radiance.sampler = Sampler(setup.device, Filter::Linear, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                               VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
}

}  // namespace voxray
