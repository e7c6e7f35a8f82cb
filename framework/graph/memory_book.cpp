#include "graph/memory_book.h"

#include <algorithm>

#include "base/error.h"

namespace voxray {
namespace {

/// What a pass may take beyond its reservations: alignment of the buffers that it makes, and a 32nd, since
/// the host, which counts voxels for estimates, rounds otherwise than the device.
uint64_t tolerance(uint64_t reserved) {
    return (64ull << 10) + reserved / 32;
}

bool isScratch(const MemoryPlan::Part& part) {
    return part.kind == MemoryPlan::Part::Scratch;
}

}  // namespace

PassMemory MemoryBook::planned() const {
    PassMemory memory;
    for (const MemoryPlan::Part& part : plan_.parts())
        (isScratch(part) ? memory.scratchBytes : memory.bytes) += part.bytes;
    return memory;
}

uint64_t MemoryBook::make(Device& device, bool scratch) const {
    const uint64_t before = device.memoryUsedBytes();
    for (const MemoryPlan::Part& part : plan_.parts())
        if (part.make && isScratch(part) == scratch) part.make(device);
    return device.memoryUsedBytes() - before;
}

void MemoryBook::check(bool scratch, uint64_t taken, uint64_t notReserved, uint64_t spareBytes) const {
    const uint64_t bytes = taken > notReserved ? taken - notReserved : 0;
    uint64_t reserved = 0, spare = 0;
    for (const MemoryPlan::Part& part : plan_.parts()) {
        if (part.make || isScratch(part) != scratch) continue;
        reserved += part.bytes;
        if (part.kind == MemoryPlan::Part::Counted) spare = spareBytes;
    }
    if (bytes > reserved + tolerance(reserved) + spare)
        throw Error(
            "pass '{}' takes {} bytes of {} memory besides the buffers and images that it describes, but "
            "reserves {}; describe or reserve them in its plan()",
            pass_, bytes, scratch ? "scratch" : "kept", reserved);
}

void MemoryBook::prepare(CommandStream& stream, const std::function<void()>& preparePass) {
    Device& device = stream.device();
    const uint64_t before = device.memoryUsedBytes();
    describedBytes_ = make(device, false);
    preparePass();
    stream.finish();
    taken_ = {device.memoryUsedBytes() - before, 0};
    check(false, taken_.bytes, describedBytes_);
}

void MemoryBook::record(CommandStream& stream, uint64_t spareBytes, const std::function<void()>& recordPass) {
    Device& device = stream.device();
    const uint64_t before = device.memoryUsedBytes();
    device.resetMemoryPeak();
    stream.resetStagingPeak();
    const uint64_t described = make(device, true);
    recordPass();

    // Scratch is free for the next pass, and so is what was staged.
    if (described > 0 || stream.stagingBytes() > 0) stream.finish();
    for (const MemoryPlan::Part& part : plan_.parts())
        if (part.make && isScratch(part)) part.free();

    // A pass may size its outputs by what it counted: what it holds now is what it keeps.
    const uint64_t after = device.memoryUsedBytes(), scratch = device.memoryPeakBytes() - after;
    taken_.bytes += after - before;
    taken_.scratchBytes = std::max(taken_.scratchBytes, scratch);
    check(false, taken_.bytes, describedBytes_, spareBytes);
    check(true, scratch, described + stream.stagingPeakBytes());
}

}  // namespace voxray
