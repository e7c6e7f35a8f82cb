#pragma once

#include <optional>
#include <string>

#include "passes/common/lights/light_sources.h"
#include "passes/common/voxels/voxel_accumulator.h"
#include "passes/surfels/surfel_paths.h"

namespace voxray {

/// The parameters of a pass that lights surfels by paths.
struct SurfelParams : WriteParams {
    /// So many that a lookup beats a constant image (docs/injection.md).
    uint32_t pathsPerPoint = 16;
    uint32_t bounces = 8;
    static constexpr auto schema() {
        return std::tuple_cat(
            WriteParams::schema(),
            std::tuple{
                field("paths_per_point", &SurfelParams::pathsPerPoint, "Paths from each point.", 1u, 1024u)
                    .lessNoise()
                    .onlyWith(noneOf(&SurfelParams::bounces, {0u})),
                field("bounces", &SurfelParams::bounces,
                      "Bounces of light; Russian roulette by albedo ends paths early.", 0u, 32u)});
    }
};

/// Light of surfels into voxels: sums of their direct and indirect irradiance, by face, and what becomes of
/// these. Direct irradiance is measured by shadow rays or handed in, indirect irradiance comes by paths.
class SurfelInjection {
 public:
    explicit SurfelInjection(ProgramOwner& owner);

    /// The rays that a pass will ask for.
    struct Rays {
        uint32_t batch = 0;         ///< Surfels in one call, at most.
        bool shadow = true;         ///< Whether direct light is measured by shadow rays.
        bool paths = true;          ///< Whether there are bounces.
        uint32_t lightSamples = 1;  ///< Shadow rays to the emissive surfaces, and to the environment.
    };
    /// Describes the memory of rays and estimates the result's. @throws Error naming `pass` for what the
    /// device can't do.
    void plan(PassPlan& plan, const std::string& pass, const WriteParams& params, const Rays& rays,
              const SurfaceVoxels& voxels);

    /// Allocates the result and the sums, and clears them.
    void begin(PassContext& context, const PathScene& scene, VoxelIrradiance& irradiance);
    /// Lights surfels by shadow rays and paths, and leaves both in their voxels.
    void light(PassContext& context, const PathScene& scene, const Buffer& surfels, uint32_t count,
               const SurfelParams& params, uint32_t seed);
    /// The same with direct irradiance that was measured otherwise. @param direct W/m², 4 floats each.
    void lightIndirect(PassContext& context, const PathScene& scene, const Buffer& surfels, uint32_t count,
                       const SurfelParams& params, uint32_t seed, const Buffer& direct);
    /// Leaves irradiance that is known in voxels. @param direct, indirect W/m², 4 floats each.
    void write(PassContext& context, const Buffer& surfels, uint32_t count, const Buffer& direct,
               const Buffer& indirect) const;
    /// Fills the result and frees the sums. Faces without surfels stay unknown. Waits for the device.
    void finish(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& irradiance);
    /// Gives faces without surfels the mean of the voxels around them.
    void fillUnknown(PassContext& context, const SurfaceVoxels& voxels,
                     const VoxelIrradiance& irradiance) const;

    /// For passes that make paths of their own.
    SurfelPaths& paths() { return *paths_; }

 private:
    void write(PassContext& context, const VoxelAccumulator& sums, const Buffer& surfels, uint32_t count,
               const Buffer& irradiance) const;

    ProgramOwner& owner_;
    std::optional<VoxelAccumulator> directSums_, indirectSums_;
    std::optional<SurfelPaths> paths_;  ///< With shadow rays or paths.
    Kernel write_, fillUnknown_;
    Buffer direct_, indirect_;  ///< Irradiance of a batch.
};

}  // namespace voxray
