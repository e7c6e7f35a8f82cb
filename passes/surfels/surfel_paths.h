#pragma once

#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

/// What paths of light go through.
struct PathScene {
    const SurfaceVoxels& voxels;
    const std::vector<LightSource>& sources;
};

/// Indirect irradiance of surfels by path tracing through streams: from each surfel a ray by cosine, shadow
/// rays to the lights at its hit, a ray on from there, and so on. Nothing is read out of voxels on the way,
/// whose mean values would lead light through walls and add up their errors from bounce to bounce.
class SurfelPaths {
 public:
    explicit SurfelPaths(ProgramOwner& owner);

    /// @param batch paths at once, at most. @param lightSamples shadow rays at each surfel to the emissive
    /// surfaces, and to the environment. @param extends whether paths go anywhere: else only measure() may be
    /// called.
    void plan(PassPlan& plan, uint32_t batch, uint32_t lightSamples, bool extends);

    /// Writes the direct irradiance of `count` surfels, W/m², 4 floats each.
    void measure(PassContext& context, const PathScene& scene, const Buffer& surfels, uint32_t count,
                 uint32_t seed, const Buffer& direct) const;

    /// Begins a path at each of `count` surfels, and clears `irradiance`, 4 floats each.
    void begin(PassContext& context, const Buffer& surfels, uint32_t count, uint32_t seed,
               const Buffer& irradiance);
    /// The normal of a path's new end: light is reflected by the shading normal; an end that is written to
    /// voxels takes the geometric one.
    enum class Normals { Shading, Geometric };
    /// Takes every path one bounce on and adds the light of its new end to `irradiance`, W/m².
    void extend(PassContext& context, const PathScene& scene, const Buffer& irradiance,
                Normals normals = Normals::Shading);
    /// Adds to `irradiance`, for each of `count` ends, what it reflects of `arriving` along its path, W/m².
    void reflect(PassContext& context, const Buffer& ends, uint32_t count, const Buffer& arriving,
                 const Buffer& irradiance) const;

    /// The ends of the paths that survived, their number, and their direct irradiance.
    const Buffer& ends() const { return ends_[0]; }
    uint32_t count() const { return count_; }
    const Buffer& direct() const { return direct_; }

 private:
    uint32_t lightSamples_ = 1, count_ = 0, seed_ = 0;
    Kernel begin_, extend_, reflect_;
    SurfelDirectLight light_;
    Buffer ends_[2], rays_[2];  ///< Present ones first.
    Buffer hits_, direct_, counter_;
};

}  // namespace voxray
