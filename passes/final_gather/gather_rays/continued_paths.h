#pragma once

#include <array>
#include <optional>
#include <vector>

#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

/// What follows at hits of gather rays where stored light is not all that is asked for: shadow rays measure
/// direct light there, and where the ray is to go on, as a path does, stored light or the same again is at
/// its end. Shaders list such hits, and count those where no light is stored (hit.glsl).
class ContinuedPaths {
 public:
    struct Settings {
        bool measureDirect = false;  ///< At every hit: stored light does not hold it.
        uint32_t lightSamples = 1;   ///< Of the emissive surfaces and of the environment, at each such hit.
        float nearField = 0;         ///< Cells: rays shorter than this go on; 0: no ray does.
        uint32_t maxSteps = 3;       ///< That a ray goes on, at most.
    };
    struct Counts {
        uint64_t rays = 0;   ///< That went on.
        uint64_t unlit = 0;  ///< Hits far enough off to read stored light, where none is.
    };

    /// @param stored where light is stored, as definitions.
    ContinuedPaths(ProgramOwner& owner, const Defines& stored);

    /// @param constants of stored light. @param rays of a batch, at most.
    void plan(PassPlan& plan, const Settings& settings, const SpecializationConstants& constants,
              uint32_t rays);
    /// What else a shader is compiled with that includes hit.glsl.
    Defines defines() const;
    /// Empties the list. @return what such a shader binds to write it.
    std::vector<Binding> begin(CommandStream& stream) const;
    /// Follows what has been listed since. Waits for the device.
    /// @param stored bindings of stored light. @param light of the batch's rays, to which it adds.
    Counts follow(PassContext& context, const std::vector<Binding>& stored, const Buffer& light) const;

 private:
    bool isUsed() const { return settings_.measureDirect || settings_.nearField > 0; }

    ProgramOwner& owner_;
    Settings settings_;
    Kernel reflect_, continue_;
    std::vector<LightSource> sources_;
    std::optional<SurfelDirectLight> hitLight_;  ///< Where it is measured.
    std::array<Buffer, 2> surfels_;  ///< At hits that were listed, and at those of one step before.
    Buffer continuations_, counts_;  ///< Of the list.
    Buffer direct_, rays_, hits_;
};

}  // namespace voxray
