#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/surfels/surfels.h"

namespace voxray {

/// Links that a change may affect and that wait for their rays, where a budget bounds the rays of a frame. Links are
/// traced in turns: those of one number at every 64th surfel are a class, and the class that has waited longest is the
/// next. So no link waits for longer than all classes take, and which ones are traced does not depend on the order of
/// threads.
class WaitingLinks {
 public:
    explicit WaitingLinks(ProgramOwner& owner);

    /// @return bytes a surfel.
    double plan(PassPlan& plan, uint32_t raysPerSurfel);
    /// No link waits.
    void clear(PassContext& context, uint32_t surfels);
    /// For shaders that mark links: bits by surfel and ray, wordsPerSurfel() words a surfel.
    Binding bits() const { return {"WaitingRef", bits_.ref()}; }
    uint32_t wordsPerSurfel() const { return (raysPerSurfel_ + 31) / 32; }

    /// Counts the links that wait. Waits for the device.
    void count(PassContext& context);
    uint64_t waiting() const;
    /// Selects whole classes, of at most `most` links. @return the number of links; 0 where the next class has more.
    uint32_t select(PassContext& context, uint64_t most);
    /// Lists the selected links of a chunk, with their rays; they wait no longer. @param list count, rays and their
    /// links: surfel, among all chunks, times rays of a surfel, plus ray.
    void list(PassContext& context, const Surfels::Chunk& chunk, uint32_t seed, const Bindings& list) const;

 private:
    Kernel count_, list_;
    uint32_t raysPerSurfel_ = 0, surfels_ = 0;
    LargeBuffer bits_;
    Buffer classCounts_, selected_;
    std::vector<uint32_t> linksOfClasses_;  ///< That wait.
    size_t next_ = 0;                       ///< Class.
};

}  // namespace voxray
