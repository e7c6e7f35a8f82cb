#pragma once

#include <optional>
#include <vector>

#include "passes/cache/hit_faces/gather_faces.h"
#include "passes/cache/hit_faces/kept/kept_faces.h"
#include "passes/cache/radiance_cache.h"

namespace voxray {

/// Cells of a radiance cache that keep their light from frame to frame. In each frame a budget of rays goes to the
/// cells by whose update the image's error is expected to fall most for each ray: KeptFaces, whose faces are cells.
class KeptCells {
 public:
    struct Params {
        float raysPerPixel;
        uint32_t pointsPerCell, bounces, lightSamples;
        float cellSize;
        uint32_t capacity;
    };
    KeptCells(Pass& pass, const Params& params);

    void plan(PassPlan& plan, std::vector<LightSource> sources);
    /// @param grid as it is in this frame.
    void update(PassContext& context, RadianceCache& cache, const gpu::RadianceCacheGrid& grid);

 private:
    const Params params_;
    In<GBuffer> gbuffer_;
    In<GatherHits> hits_;
    GatherFaces gatherFaces_;
    NewFaces newFaces_;
    PointBatch batch_;
    KeptFaces kept_;
    Kernel write_;
    HitFaceLight light_;
    Buffer lost_;                           ///< Number of rays that hit where no cell has room.
    std::optional<uint64_t> sceneVersion_;  ///< Of the light that is kept.
};

}  // namespace voxray
