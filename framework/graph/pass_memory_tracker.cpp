#include "graph/pass_memory_tracker.h"

#include <algorithm>

namespace voxray {

PassMemory PassMemoryTracker::planned() const {
    PassMemory memory;
    for (const MemoryPlan::Part& part : plan_.parts())
        (part.isScratch ? memory.scratchBytes : memory.bytes) += part.bytes;
    memory.estimatedBytes = plan_.estimatedBytes();
    return memory;
}

bool PassMemoryTracker::make(Device& device, bool scratch) const {
    bool any = false;
    for (const MemoryPlan::Part& part : plan_.parts()) {
        if (part.isScratch != scratch) continue;
        part.make(device);
        any = true;
    }
    return any;
}

void PassMemoryTracker::prepare(CommandStream& stream, const std::function<void()>& preparePass) {
    Device& device = stream.device();
    const uint64_t before = device.memoryUsedBytes();
    make(device, false);
    preparePass();
    stream.finish();
    taken_ = {device.memoryUsedBytes() - before, 0};
}

void PassMemoryTracker::record(CommandStream& stream, const std::function<void()>& recordPass) {
    Device& device = stream.device();
    const uint64_t before = device.memoryUsedBytes();
    device.resetMemoryPeak();
    const bool hasScratch = make(device, true);
    recordPass();

    // Scratch is free for the next pass, and so is what was staged.
    if (hasScratch || stream.stagingBytes() > 0) stream.finish();
    for (const MemoryPlan::Part& part : plan_.parts())
        if (part.isScratch) part.free();

    // A pass may size its outputs by what it counted: what it holds now is what it keeps.
    const uint64_t after = device.memoryUsedBytes();
    taken_.bytes += after - before;
    taken_.scratchBytes = std::max(taken_.scratchBytes, device.memoryPeakBytes() - after);
}

}  // namespace voxray
