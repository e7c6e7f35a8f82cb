#pragma once

#include <array>
#include <optional>
#include <vector>

#include "passes/final_gather/stored_light/stored_light_params.h"
#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

/// Paths that continue gather rays whose hits cannot be shaded by stored light alone (shade_hit.glsl lists
/// these hits). Shadow rays measure direct light at such a hit; where the path continues, a further ray adds
/// indirect light, whose hit is shaded in the same way.
class ContinuedPaths {
 public:
    struct Counts {
        uint64_t rays = 0;   ///< Continuation rays.
        uint64_t unlit = 0;  ///< Hits beyond the near field where no light is stored.
    };

    /// @param stored definitions of stored light.
    ContinuedPaths(ProgramOwner& owner, const Defines& stored);

    /// @param measureDirect at every hit, as stored light is only indirect. @param rays maximum number of gather
    /// rays in a batch.
    void plan(PassPlan& plan, const StoredLightParams& params, bool measureDirect, uint32_t rays);
    /// Further definitions of shaders that include shade_hit.glsl.
    Defines defines() const;
    /// Empties the list of hits. @return bindings of shaders that append to it.
    std::vector<Binding> clearHits(CommandStream& stream) const;
    /// Adds light of the listed hits, and of the paths that continue from them, to that of the gather rays.
    /// Waits for the device. @param stored bindings of stored light. @param light of the batch's gather rays.
    Counts trace(PassContext& context, const std::vector<Binding>& stored, const Buffer& light) const;

 private:
    bool isUsed() const { return measureDirect_ || params_.nearFieldCells > 0; }
    /// Maximum continuation rays of a path. Where light is stored for some places only paths have eight bounces.
    uint32_t maxSteps() const {
        return params_.source == GatherSource::RadianceCache || params_.source == GatherSource::HitFaces ? 7 : 3;
    }

    ProgramOwner& owner_;
    StoredLightParams params_;
    bool measureDirect_ = false;
    Kernel reflect_, continue_;
    std::vector<LightSource> sources_;
    std::optional<SurfelDirectLight> hitLight_;
    std::array<Buffer, 2> surfels_;  ///< At listed hits; read and written in turn by the steps of paths.
    Buffer continuations_, counts_;  ///< shade_hit.glsl
    Buffer direct_, rays_, hits_;
};

}  // namespace voxray
