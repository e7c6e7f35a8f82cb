#pragma once

#include <functional>
#include <string>

#include "graph/memory_plan.h"
#include "vulkan/commands.h"

namespace voxray {

/// The memory of one pass while the graph runs: makes and frees what the pass described, measures what it
/// takes, and holds it to what it planned.
class MemoryBook {
 public:
    MemoryBook() = default;
    MemoryBook(std::string pass, MemoryPlan plan) : pass_(std::move(pass)), plan_(std::move(plan)) {}

    const MemoryPlan& plan() const { return plan_; }
    PassMemory planned() const;
    /// What the pass has taken so far.
    const PassMemory& taken() const { return taken_; }

    /// Makes what is kept, then calls `preparePass`. Waits for the device.
    /// @throws Error where the pass keeps more than it reserved.
    void prepare(CommandStream& stream, const std::function<void()>& preparePass);
    /// Makes scratch, calls `recordPass` and frees it, for which it waits for the device where there is any.
    /// @param spareBytes that a pass with counted parts may keep beyond what it reserved.
    /// @throws Error where the pass takes more than that. Staging buffers of the stream aren't counted.
    void record(CommandStream& stream, uint64_t spareBytes, const std::function<void()>& recordPass);

 private:
    uint64_t make(Device& device, bool scratch) const;
    /// @throws Error where `taken` bytes, less those that need no reservation, are more than was reserved.
    void check(bool scratch, uint64_t taken, uint64_t notReserved, uint64_t spareBytes = 0) const;

    std::string pass_;
    MemoryPlan plan_;
    PassMemory taken_;
    uint64_t describedBytes_ = 0;  ///< Allocated for what is described and kept, with the driver's padding.
};

}  // namespace voxray
