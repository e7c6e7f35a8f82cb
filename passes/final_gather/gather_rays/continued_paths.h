#pragma once

#include <array>
#include <optional>
#include <vector>

#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

/// Paths that continue gather rays whose hits cannot be shaded by stored light alone (shade_hit.glsl lists
/// these hits). Shadow rays measure direct light at such a hit; where the path continues, a further ray adds
/// indirect light, whose hit is shaded in the same way.
class ContinuedPaths {
 public:
    struct Settings {
        bool measureDirect = false;  ///< At every hit, as stored light is only indirect.
        uint32_t lightSamples = 1;   ///< Shadow rays to emissive surfaces, and to the environment.
        float nearField = 0;         ///< Cells: paths continue from hits closer than this; 0: none does.
        uint32_t maxSteps = 3;       ///< Maximum continuation rays of a path.
    };
    struct Counts {
        uint64_t rays = 0;   ///< Continuation rays.
        uint64_t unlit = 0;  ///< Hits beyond the near field where no light is stored.
    };

    /// @param stored definitions of stored light.
    ContinuedPaths(ProgramOwner& owner, const Defines& stored);

    /// @param rays maximum number of gather rays in a batch.
    void plan(PassPlan& plan, const Settings& settings, uint32_t rays);
    /// Further definitions of shaders that include shade_hit.glsl.
    Defines defines() const;
    /// Empties the list of hits. @return bindings of shaders that append to it.
    std::vector<Binding> clearHits(CommandStream& stream) const;
    /// Adds light of the listed hits, and of the paths that continue from them, to that of the gather rays.
    /// Waits for the device. @param stored bindings of stored light. @param light of the batch's gather rays.
    Counts trace(PassContext& context, const std::vector<Binding>& stored, const Buffer& light) const;

 private:
    bool isUsed() const { return settings_.measureDirect || settings_.nearField > 0; }

    ProgramOwner& owner_;
    Settings settings_;
    Kernel reflect_, continue_;
    std::vector<LightSource> sources_;
    std::optional<SurfelDirectLight> hitLight_;
    std::array<Buffer, 2> surfels_;  ///< At listed hits; read and written in turn by the steps of paths.
    Buffer continuations_, counts_;  ///< shade_hit.glsl
    Buffer direct_, rays_, hits_;
};

}  // namespace voxray
