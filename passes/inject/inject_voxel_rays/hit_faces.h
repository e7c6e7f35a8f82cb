#pragma once

#include "graph/pass.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfels.h"

namespace voxray {

/// The faces of voxels that the frame's gather rays will read, and the surfels on them.
class HitFaces {
 public:
    explicit HitFaces(ProgramOwner& owner);

    void plan(PassPlan& plan);
    /// Marks the faces that are read at the hits.
    void mark(PassContext& context, const SurfaceVoxels& voxels, const Surfels& surfels,
              const GBuffer& gbuffer, const GatherHits& hits);
    /// Picks the surfels of a chunk that are on marked faces. @return how many; waits for the device.
    uint32_t select(PassContext& context, const Surfels::Chunk& chunk) const;
    /// Those that were picked last.
    const Buffer& selected() const { return selected_; }

 private:
    Kernel measure_, mark_, select_;
    Buffer selected_, count_;  ///< Of a chunk's surfels, those to light.
    Buffer faces_;             ///< A bit for each face that is read, in a word for each voxel.
    Buffer measured_;          ///< The same for each face that has surfels.
};

}  // namespace voxray
