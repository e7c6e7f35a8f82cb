#pragma once

#include <vector>

#include "passes/probes/update_probes/probe_rays.h"

namespace voxray {

/// Moves probes off surfaces and turns those off that light nothing. Source: Majercik et al. 2021, sections 5 and 6.
class ProbePlacement {
 public:
    struct Settings {
        uint32_t relocationSteps;
        bool classifies;
        float backfaceThreshold, minDistance;
        bool backsAreDark;
    };
    explicit ProbePlacement(ProgramOwner& owner);

    void plan(const Settings& settings);
    /// Places the probes of a list anew.
    void place(PassContext& context, const Probes& probes, ProbeRays& rays, const std::vector<uint32_t>& list);
    /// Probes that were on after the last place().
    const std::vector<uint32_t>& active() const { return active_; }
    void report(PassContext& context) const;

 private:
    Settings settings_{};
    Kernel reset_, relocate_, classify_;
    std::vector<uint32_t> active_;
    uint32_t probes_ = 0, inSurfaces_ = 0;
};

}  // namespace voxray
