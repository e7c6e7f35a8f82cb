#include "scene/memory_budget.h"

#include <unistd.h>

#include <algorithm>

#include "base/error.h"

namespace voxray {

void MemoryBudget::reserve(uint64_t count, uint64_t bytesEach) {
    const uint64_t limit = uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE)) / 2;
    if (count > (limit - std::min(limit, reservedBytes_)) / bytesEach)
        throw Error("it needs more than {} MiB, half of this machine's memory; use a smaller scene", limit >> 20);
    reservedBytes_ += count * bytesEach;
}

}  // namespace voxray
