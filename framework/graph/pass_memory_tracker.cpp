#include "graph/pass_memory_tracker.h"

#include <algorithm>

#include "vulkan/live_memory.h"

namespace voxray {

PassMemory PassMemoryTracker::planned() const {
    PassMemory memory;
    for (const MemoryPlan::Allocation& allocation : plan_.allocations())
        (allocation.isScratch ? memory.scratchBytes : memory.bytes) += allocation.bytes;
    memory.estimatedBytes = plan_.estimatedBytes();
    return memory;
}

bool PassMemoryTracker::make(Device& device, bool scratch) const {
    bool made = false;
    for (const MemoryPlan::Allocation& allocation : plan_.allocations()) {
        if (allocation.isScratch != scratch) continue;
        allocation.make(device);
        made = true;
    }
    return made;
}

void PassMemoryTracker::prepare(CommandStream& stream, const std::function<void()>& preparePass) {
    Device& device = stream.device();
    const uint64_t before = device.memoryUsedBytes();
    maker_ = device.liveMemory().newMaker();
    const LiveMemory::Making making(device.liveMemory(), maker_);
    make(device, false);
    preparePass();
    stream.finish();
    used_ = {device.memoryUsedBytes() - before, 0};
}

void PassMemoryTracker::record(CommandStream& stream, const std::function<void()>& recordPass) {
    Device& device = stream.device();
    const uint64_t before = device.memoryUsedBytes();
    const LiveMemory::Making making(device.liveMemory(), maker_);
    device.resetMemoryPeak();
    const bool hasScratch = make(device, true);
    recordPass();

    // The next pass may reuse scratch and staging memory.
    if (hasScratch || stream.stagingBytes() > 0) stream.finish();
    for (const MemoryPlan::Allocation& allocation : plan_.allocations())
        if (allocation.isScratch) allocation.free();

    // Persistent memory may have grown: a pass may size its outputs by a count.
    const uint64_t after = device.memoryUsedBytes();
    used_.bytes += after - before;
    used_.scratchBytes = std::max(used_.scratchBytes, device.memoryPeakBytes() - after);
}

}  // namespace voxray
