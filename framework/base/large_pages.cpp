#include "base/large_pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace voxray {
namespace {

constexpr size_t kLargePage = size_t(2) << 20;

}  // namespace

void adviseLargePages(void* memory, size_t bytes) {
    if (bytes < kLargePage) return;
    // Whole pages only: their neighbors' memory is not ours
    const auto page = uintptr_t(sysconf(_SC_PAGESIZE)), begin = uintptr_t(memory), end = begin + bytes;
    const uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
    if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

}  // namespace voxray
