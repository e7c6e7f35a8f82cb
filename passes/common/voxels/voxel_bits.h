#pragma once

#include <atomic>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

namespace voxray {

/// A set of voxels in a box, a bit each, on the host.
class VoxelBits {
 public:
    explicit VoxelBits(glm::uvec3 size)
        : size_(size), wordsPerRow_((size.x + 63) / 64), words_(wordsPerRow_ * size.y * size.z, 0) {}

    glm::uvec3 size() const { return size_; }
    /// Marks a voxel of the box; thread-safe. Bits that are set already are only read.
    void mark(glm::ivec3 v) {
        const std::atomic_ref<uint64_t> bits(words_[word(v)]);
        const uint64_t bit = 1ull << (v.x % 64);
        if (!(bits.load(std::memory_order_relaxed) & bit)) bits.fetch_or(bit, std::memory_order_relaxed);
    }
    bool isInside(glm::ivec3 v) const {
        return glm::all(glm::greaterThanEqual(v, glm::ivec3(0))) && glm::all(glm::lessThan(v, glm::ivec3(size_)));
    }
    /// Whether a voxel is marked; false outside the box.
    bool operator[](glm::ivec3 v) const { return isInside(v) && words_[word(v)] >> (v.x % 64) & 1; }
    uint32_t count() const {
        uint32_t sum = 0;
        for (const uint64_t bits : words_) sum += uint32_t(std::popcount(bits));
        return sum;
    }

 private:
    size_t word(glm::ivec3 v) const { return (size_t(v.z) * size_.y + size_t(v.y)) * wordsPerRow_ + size_t(v.x) / 64; }
    glm::uvec3 size_;
    size_t wordsPerRow_;
    std::vector<uint64_t> words_;
};

}  // namespace voxray
