#pragma once

#include <functional>
#include <vector>

#include "passes/probes/probes.h"

namespace voxray {

/// A batch of probe rays: rays and hits of the probes [first, first + count) of a list, probe by probe.
struct ProbeBatch {
    uint32_t first, count, rays;
};

/// Rays from probes in the directions of a spherical Fibonacci set, which all probes share and each update
/// rotates. Source: Majercik et al. 2019, section 4.
class ProbeRays {
 public:
    explicit ProbeRays(ProgramOwner& owner);

    /// @param maxProbes in a list.
    void plan(PassPlan& plan, uint32_t raysPerProbe, uint32_t maxProbes);
    /// Maximum number of rays in a batch.
    uint32_t batchRays() const { return batchProbes_ * raysPerProbe_; }

    /// The probes to trace rays from, by number.
    void setList(CommandStream& stream, const std::vector<uint32_t>& list);
    /// Traces the rays of the probes in the list, and calls `use` after each batch.
    /// @param seed of the directions' rotation; 0: none.
    void trace(PassContext& context, const Probes& probes, uint32_t seed,
               const std::function<void(const ProbeBatch&)>& use);
    /// The list; directions, rays and hits of the last batch.
    std::vector<Binding> bindings() const;

 private:
    Kernel generate_;
    uint32_t raysPerProbe_ = 1, batchProbes_ = 1, listed_ = 0;
    Buffer list_, directions_, rays_, hits_;
};

}  // namespace voxray
