#include <fmt/ranges.h>

#include <glm/gtx/component_wise.hpp>

#include "base/error.h"
#include "passes/common/triangle_voxelizer/raster_voxelizer.h"

namespace voxray {
namespace {

/// How the pixels of a projected triangle are found.
enum class Coverage {
    Grown,         ///< Those that it touches: shaders grow it by half a pixel (Hasselgren et al. 2005).
    Hardware,      ///< Those that it touches: the device's conservative rasterization.
    Multisampled,  ///< Those with a sample in it, of the device's places.
    Sampled        ///< The same of 1 or 8 places, tested in a shader.
};

/// Rasterization in one pass. A geometry shader projects each triangle along its dominant axis; a pixel is a
/// column of voxels along it, and yields all voxels that the triangle's plane passes through there. Sources:
/// Magalhães 2020, section 3.2.4.3; Crassin and Green 2012 (conservative, and multisampled).
///
/// Sampled is as published in Arnebäck 2017, section 3.2.1: a pixel yields one voxel, at the depth of the plane
/// in the pixel's center.
class DominantAxisVoxelizer final : public RasterVoxelizer {
 public:
    /// @param samples per pixel, where there are some.
    explicit DominantAxisVoxelizer(Coverage coverage, uint32_t samples = 1) : coverage_(coverage), samples_(samples) {}

    void plan(PassPlan& plan) override {
        requireFeatures(plan.device);
        RasterVoxelizer::plan(plan);
    }

    std::unique_ptr<PassProgram> makeProgram(ProgramOwner& owner, const std::string& shader,
                                             const Defines& defines) const override {
        Defines methodDefines = defines;
        methodDefines.emplace(coverage_ == Coverage::Sampled ? "SAMPLED_AXIS" : "DOMINANT_AXIS", "1");
        if (isByDevice()) methodDefines.emplace("DRAWN_BY_DEVICE", "1");
        if (coverage_ == Coverage::Multisampled) methodDefines.emplace("MULTISAMPLED", "1");
        const std::vector<std::string> files{"passes/common/triangle_voxelizer/dominant_axis.vert",
                                             "passes/common/triangle_voxelizer/dominant_axis.geom", shader + ".frag"};
        RasterState state;
        state.isConservative = coverage_ == Coverage::Hardware;
        if (coverage_ == Coverage::Multisampled) state.samples = samples_;
        return std::make_unique<RasterPipeline>(owner, files, state, methodDefines);
    }

    void run(PassContext& context, const Program& program, const gpu::VoxelGrid& grid,
             std::span<const Binding> bindings, float fixedPointScale) const override {
        // One square image that holds the columns along any axis.
        const uint32_t side = glm::compMax(grid.resolution - glm::uvec3(grid.first));
        RasterTargets targets;
        targets.extent = {side, side, 1};
        context.stream.draw(program, targets, corners(),
                            {allBindings(context, bindings),
                             {"grid", grid},
                             {"fixedPointScale", fixedPointScale},
                             {"tiles", 0u},
                             {"axis", 0u},
                             {"samples", samples_}});
    }

 private:
    bool isByDevice() const { return coverage_ == Coverage::Hardware || coverage_ == Coverage::Multisampled; }
    void requireFeatures(const DeviceInfo& device) const;

    Coverage coverage_;
    uint32_t samples_;
};

void DominantAxisVoxelizer::requireFeatures(const DeviceInfo& device) const {
    if (!device.geometryShader)
        throw Error("{} needs geometry shaders (geometryShader), which device '{}' lacks; use {}",
                    coverage_ == Coverage::Sampled ? "rasterization as in Arnebäck 2017"
                                                   : "voxelize: rasterization along the dominant axis",
                    device.name,
                    coverage_ == Coverage::Sampled ? "voxelize and filter_voxels, or voxelize_clipmap and light_clipmap"
                                                   : "method exact");
    if (coverage_ == Coverage::Hardware && !device.conservativeRaster)
        throw Error(
            "voxelize: method hardware_conservative needs VK_EXT_conservative_rasterization, which device '{}' lacks; "
            "method dominant_axis does the same by shaders",
            device.name);
    if (coverage_ == Coverage::Multisampled && !(device.sampleCounts & samples_))
        throw Error("voxelize: msaa_samples {}: device '{}' has targets of {} samples a pixel", samples_, device.name,
                    fmt::join(listSampleCounts(device), ", "));
}

}  // namespace

std::unique_ptr<TriangleVoxelizer> makeDominantAxisVoxelizer() {
    return std::make_unique<DominantAxisVoxelizer>(Coverage::Grown);
}

std::unique_ptr<TriangleVoxelizer> makeHardwareConservativeVoxelizer() {
    return std::make_unique<DominantAxisVoxelizer>(Coverage::Hardware);
}

std::unique_ptr<TriangleVoxelizer> makeMultisampledVoxelizer(uint32_t samples) {
    return std::make_unique<DominantAxisVoxelizer>(Coverage::Multisampled, samples);
}

std::unique_ptr<TriangleVoxelizer> makeSampledAxisVoxelizer(uint32_t samples) {
    return std::make_unique<DominantAxisVoxelizer>(Coverage::Sampled, samples);
}

}  // namespace voxray
