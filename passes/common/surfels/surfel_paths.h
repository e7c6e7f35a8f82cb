#pragma once

#include "passes/common/surfels/surfel_light.h"
#include "passes/common/voxels/voxel_accumulator.h"

namespace voxray {

/// Direct and indirect irradiance of surfels by path tracing through streams: shadow rays at each surfel, one
/// ray on by cosine, a surfel at its hit, and so on. Both are left in voxels.
class SurfelPaths {
 public:
    struct Settings {
        Write write = Write::Average;
        uint32_t batch = 0;  ///< Surfels at once, at most.
        uint32_t bounces = 0;
        uint32_t lightSamples = 1;  ///< Of the emissive surfaces and of the environment, at each surfel.
        bool secondary = false;     ///< Also write to the voxels of what the first surfels' rays hit.
        uint32_t levels() const { return 1 + bounces + (secondary ? 1 : 0); }
    };
    void plan(PassPlan& plan, const Settings& settings);
    void prepare(PassSetup& setup);

    struct Targets {
        const SurfaceVoxels& voxels;
        const VoxelAccumulator& direct;
        const VoxelAccumulator& indirect;
    };
    /// Where the first surfels go, before run().
    const Buffer& first() const { return levels_[0].surfels; }
    /// Traces a batch of `count` first surfels.
    void run(PassContext& context, const std::vector<LightSource>& sources, uint32_t count, uint32_t seed,
             const Targets& targets);

    /// What the area that a camera ray stands for follows from; rays are spread evenly over the image.
    struct CameraFootprint {
        glm::vec3 forward{0.0f};  ///< Unit length.
        float imageArea = 0;      ///< Of the image 1 m before the camera, over the area of all surfaces.
        /// Most that a ray may stand for, what a plane has in a voxel: times the rays, over all area.
        float maxArea = 0;
    };
    /// Makes surfels of the hits of `rays`, for rays that start at a camera. @return their number.
    uint32_t arrive(PassContext& context, const SurfaceVoxels& voxels, const CameraFootprint& camera,
                    const Buffer& rays, const Buffer& hits, uint32_t count, uint32_t firstId);

 private:
    struct Level {
        Buffer surfels, direct, indirect;
        uint32_t count = 0;
    };
    uint32_t makeSurfels(PassContext& context, const SurfaceVoxels& voxels, const Buffer& rays,
                         const Buffer& hits, const Buffer& parents, const Buffer& surfels, uint32_t count,
                         uint32_t firstId, bool fromSurfels, uint32_t seed, const CameraFootprint& camera);

    Settings settings_;
    Program gather_, arrive_, return_, write_;
    SurfelLight light_;
    Buffer rays_, hits_, count_;
    std::vector<Level> levels_;
};

}  // namespace voxray
