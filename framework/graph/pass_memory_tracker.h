#pragma once

#include <functional>
#include <utility>

#include "graph/memory_plan.h"
#include "vulkan/commands.h"

namespace voxray {

/// Memory of one pass while the graph runs: makes and frees what the pass described, and measures its use.
class PassMemoryTracker {
 public:
    PassMemoryTracker() = default;
    explicit PassMemoryTracker(MemoryPlan plan) : plan_(std::move(plan)) {}

    /// Described and estimated memory.
    PassMemory planned() const;
    /// Measured memory so far.
    const PassMemory& used() const { return used_; }
    /// Of the memory that it made and that exists, in LiveMemory; 0 before prepare().
    uint64_t maker() const { return maker_; }

    /// Makes persistent memory, then calls `preparePass`. Waits for the device.
    void prepare(CommandStream& stream, const std::function<void()>& preparePass);
    /// Makes scratch, calls `recordPass` and frees scratch. Waits for the device if there is any scratch.
    void record(CommandStream& stream, const std::function<void()>& recordPass);

 private:
    /// @return whether anything was made.
    bool make(Device& device, bool scratch) const;

    MemoryPlan plan_;
    PassMemory used_;
    uint64_t maker_ = 0;
};

}  // namespace voxray
