#pragma once

#include <cstddef>
#include <vector>

namespace voxray {

/// Asks for large pages (Linux: 2 MiB) for memory that has not been written yet. Where the system has none, or less
/// than one fits, nothing happens.
void adviseLargePages(void* memory, size_t bytes);

/// Reserves room for an array that is read at random: with large pages more of its addresses are in the processor's
/// table of pages (TLB). Call it before elements are written.
template <typename T>
void reserveInLargePages(std::vector<T>& array, size_t count) {
    array.reserve(count);
    adviseLargePages(array.data(), array.capacity() * sizeof(T));
}

}  // namespace voxray
