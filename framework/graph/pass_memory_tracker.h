#pragma once

#include <functional>
#include <utility>

#include "graph/memory_plan.h"
#include "vulkan/commands.h"

namespace voxray {

/// The memory of one pass while the graph runs: makes and frees what the pass described, and measures what it
/// takes.
class PassMemoryTracker {
 public:
    PassMemoryTracker() = default;
    explicit PassMemoryTracker(MemoryPlan plan) : plan_(std::move(plan)) {}

    /// What the pass described, and what it estimates besides.
    PassMemory planned() const;
    /// What the pass has taken so far.
    const PassMemory& taken() const { return taken_; }

    /// Makes what is kept, then calls `preparePass`. Waits for the device.
    void prepare(CommandStream& stream, const std::function<void()>& preparePass);
    /// Makes scratch, calls `recordPass` and frees it, for which it waits for the device where there is any.
    void record(CommandStream& stream, const std::function<void()>& recordPass);

 private:
    /// @return whether there is any of that kind.
    bool make(Device& device, bool scratch) const;

    MemoryPlan plan_;
    PassMemory taken_;
};

}  // namespace voxray
