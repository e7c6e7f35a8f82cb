#include "passes/common/voxels/voxel_count.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "passes/common/voxels/triangle_voxels.h"

namespace voxray {
namespace {

/// A bit for each voxel of a level.
class Bits {
 public:
    explicit Bits(glm::uvec3 size)
        : size_(size), wordsPerRow_((size.x + 63) / 64), words_(wordsPerRow_ * size.y * size.z, 0) {}

    glm::uvec3 size() const { return size_; }
    /// From any thread. Most voxels are marked again and again: these are only read.
    void mark(glm::ivec3 v) {
        const std::atomic_ref<uint64_t> bits(words_[word(v)]);
        const uint64_t bit = 1ull << (v.x % 64);
        if (!(bits.load(std::memory_order_relaxed) & bit)) bits.fetch_or(bit, std::memory_order_relaxed);
    }
    uint32_t count() const {
        uint32_t sum = 0;
        for (const uint64_t bits : words_) sum += uint32_t(std::popcount(bits));
        return sum;
    }
    template <typename Visit>
    void forEach(const Visit& visit) const {
        for (glm::ivec3 v(0); v.z < int(size_.z); ++v.z)
            for (v.y = 0; v.y < int(size_.y); ++v.y)
                for (size_t i = 0; i < wordsPerRow_; ++i)
                    for (uint64_t bits = words_[word({int(64 * i), v.y, v.z})]; bits; bits &= bits - 1)
                        visit(glm::ivec3(64 * int(i) + std::countr_zero(bits), v.y, v.z));
    }

 private:
    size_t word(glm::ivec3 v) const {
        return (size_t(v.z) * size_.y + size_t(v.y)) * wordsPerRow_ + size_t(v.x) / 64;
    }
    glm::uvec3 size_;
    size_t wordsPerRow_;
    std::vector<uint64_t> words_;
};

/// The most voxels that a window of `side` voxels holds.
uint32_t fullestWindow(const Bits& bits, uint32_t side) {
    // Voxels by block
    const int block = int(side) / 4;
    const glm::ivec3 blocks = (glm::ivec3(bits.size()) + block - 1) / block;
    std::vector<uint32_t> sums(size_t(blocks.x) * size_t(blocks.y) * size_t(blocks.z), 0);
    const auto at = [&](glm::ivec3 b) {
        return (size_t(b.z) * size_t(blocks.y) + size_t(b.y)) * size_t(blocks.x) + size_t(b.x);
    };
    bits.forEach([&](glm::ivec3 v) { ++sums[at(v / block)]; });

    // Sums over the blocks that a window meets, along one axis after the other: all up to four, else five
    for (int axis = 0; axis < 3; ++axis) {
        const int reach = blocks[axis] <= 4 ? blocks[axis] : 5;
        for (glm::ivec3 b(0); b.z < blocks.z; ++b.z)
            for (b.y = 0; b.y < blocks.y; ++b.y)
                for (b.x = 0; b.x < blocks.x; ++b.x) {
                    glm::ivec3 next = b;
                    for (++next[axis]; next[axis] < std::min(b[axis] + reach, blocks[axis]); ++next[axis])
                        sums[at(b)] += sums[at(next)];
                }
    }
    return *std::ranges::max_element(sums);
}

/// What `measure` finds at each level of the voxels that the triangles chosen by `selected` pass through.
template <typename Measure>
std::vector<uint32_t> count(const Geometry& geometry, const gpu::VoxelGrid& grid,
                            const std::vector<bool>& selected, const Measure& measure) {
    Bits bits(grid.resolution);
    parallelRanges(geometry.triangles.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t) {
            if (!selected[t]) continue;
            const std::array<glm::dvec3, 3> corners = cornersInVoxels(geometry, grid, uint32_t(t));
            visitVoxels(bits.size(), corners, 0, [&](glm::ivec3 voxel) { bits.mark(voxel); });
        }
    });

    std::vector<uint32_t> counts{measure(bits)};
    while (bits.size() != glm::uvec3(1)) {
        Bits coarser((bits.size() + 1u) / 2u);
        bits.forEach([&](glm::ivec3 v) { coarser.mark(v / 2); });
        bits = std::move(coarser);
        counts.push_back(measure(bits));
    }
    return counts;
}

/// Whether each triangle stays where it is.
std::vector<bool> stillTriangles(const Geometry& geometry) {
    std::vector<bool> still(geometry.triangles.size(), true);
    for (const InstanceRange& run : movingRuns(geometry))
        std::fill_n(still.begin() + run.firstTriangle, run.triangleCount, false);
    return still;
}

/// Of what stays, and twice of what moves.
template <typename Measure>
std::vector<uint32_t> countStillAndMoving(const Geometry& geometry, const gpu::VoxelGrid& grid,
                                          const Measure& measure) {
    std::vector<bool> still = stillTriangles(geometry);
    std::vector<uint32_t> counts = count(geometry, grid, still, measure);
    if (movingRuns(geometry).empty()) return counts;

    still.flip();
    const std::vector<uint32_t> moving = count(geometry, grid, still, measure);
    for (size_t level = 0; level < counts.size(); ++level) counts[level] += 2 * moving[level];
    return counts;
}

}  // namespace

std::vector<uint32_t> countSurfaceVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    return countStillAndMoving(geometry, grid, [](const Bits& bits) { return bits.count(); });
}

std::vector<uint32_t> countWindowVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t side) {
    return countStillAndMoving(geometry, grid, [&](const Bits& bits) { return fullestWindow(bits, side); });
}

uint32_t countStillVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    return count(geometry, grid, stillTriangles(geometry), [](const Bits& bits) { return bits.count(); })
        .front();
}

}  // namespace voxray
