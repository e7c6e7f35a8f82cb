#pragma once

#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

/// What paths are traced through.
struct PathScene {
    const SurfaceVoxels& voxels;
    const std::vector<LightSource>& sources;
};

/// Indirect irradiance of surfels by path tracing in streams (wavefronts): a path from each surfel, extended
/// by a cosine-distributed ray at a time, with next event estimation at each vertex. Paths read no light from
/// voxels, whose means would leak light through walls and add up their errors from bounce to bounce.
class SurfelPaths {
 public:
    explicit SurfelPaths(ProgramOwner& owner);

    /// @param maxPaths at once. @param lightSamples shadow rays of a vertex to the emissive surfaces, and to
    /// the environment. @param hasPaths false: only measureDirect() may be called.
    void plan(PassPlan& plan, uint32_t maxPaths, uint32_t lightSamples, bool hasPaths);

    /// Writes the direct irradiance of `count` surfels, W/m², 4 floats each.
    void measureDirect(PassContext& context, const PathScene& scene, const Buffer& surfels, uint32_t count,
                       uint32_t seed, const Buffer& direct) const;

    /// Starts a path at each of `count` surfels, and clears `irradiance`, 4 floats each.
    void init(PassContext& context, const Buffer& surfels, uint32_t count, uint32_t seed, const Buffer& irradiance);
    /// The normals of vertices: shading normals, as light is reflected, or geometric ones, as it is written
    /// to voxels.
    enum class Normals { Shading, Geometric };
    /// Extends all paths by a vertex, and adds its light to `irradiance`, W/m².
    void extend(PassContext& context, const PathScene& scene, const Buffer& irradiance,
                Normals normals = Normals::Shading);
    /// Adds to `irradiance` what `count` vertices reflect of `vertexIrradiance` along their paths, W/m².
    void accumulate(PassContext& context, const Buffer& vertices, uint32_t count, const Buffer& vertexIrradiance,
                    const Buffer& irradiance) const;

    /// The last vertices of the paths that survived, their number, and their direct irradiance.
    const Buffer& vertices() const { return vertices_[0]; }
    uint32_t count() const { return count_; }
    const Buffer& direct() const { return direct_; }

 private:
    uint32_t lightSamples_ = 1, count_ = 0, seed_ = 0;
    Kernel init_, extend_, accumulate_;
    SurfelDirectLight directLight_;
    Buffer vertices_[2], rays_[2];  ///< Current and next.
    Buffer hits_, direct_, counter_;
};

}  // namespace voxray
