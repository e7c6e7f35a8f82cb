#include "passes/common/voxels/voxel_count.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/parallel.h"

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

/// Marks the voxels that a triangle, in units of voxels, passes through.
void markTriangle(Bits& bits, const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const glm::dvec3 size = glm::abs(normal);
    const int w = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = (w + 1) % 3, v = (w + 2) % 3;
    if (size[w] <= 0) return;
    const glm::dvec3 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::dvec3 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
    const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(low)), glm::ivec3(0));
    const glm::ivec3 last = glm::min(glm::ivec3(glm::floor(high)), glm::ivec3(bits.size()) - 1);

    // Within one voxel
    if (first == last) {
        bits.mark(first);
        return;
    }

    // Edges as lines in the plane across the axis: outward normal and the most that a point inside reaches
    // along it.
    std::array<glm::dvec3, 3> edges;  // (normal u, normal v, reach)
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 along = corners[(i + 1) % 3] - corners[i];
        const glm::dvec2 outward = (normal[w] > 0 ? 1.0 : -1.0) * glm::dvec2(along[v], -along[u]);
        edges[i] = {outward, outward.x * corners[i][u] + outward.y * corners[i][v]};
    }
    const double slopeU = -normal[u] / normal[w], slopeV = -normal[v] / normal[w];
    for (int y = first[v]; y <= last[v]; ++y)
        for (int x = first[u]; x <= last[u]; ++x) {
            // A column is passed by where for each edge its nearest corner is outside.
            const bool outside = std::ranges::any_of(edges, [&](const glm::dvec3& e) {
                return e.x * (e.x < 0 ? x + 1 : x) + e.y * (e.y < 0 ? y + 1 : y) > e.z;
            });
            if (outside) continue;
            const double center =
                corners[0][w] + slopeU * (x + 0.5 - corners[0][u]) + slopeV * (y + 0.5 - corners[0][v]);
            const double reach = 0.5 * (std::abs(slopeU) + std::abs(slopeV));
            const int from = std::max(int(std::floor(std::max(center - reach, low[w]))), first[w]);
            const int to = std::min(int(std::floor(std::min(center + reach, high[w]))), last[w]);
            glm::ivec3 voxel;
            voxel[u] = x;
            voxel[v] = y;
            for (voxel[w] = from; voxel[w] <= to; ++voxel[w]) bits.mark(voxel);
        }
}

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
    const glm::dvec3 origin(grid.origin);
    parallelRanges(geometry.triangles.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t) {
            if (!selected[t]) continue;
            std::array<glm::dvec3, 3> corners;
            for (int i = 0; i < 3; ++i)
                corners[size_t(i)] = (glm::dvec3(geometry.positions[geometry.triangles[t][i]]) - origin) /
                                     double(grid.voxelSize);
            markTriangle(bits, corners);
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

/// Of what stays, and twice of what moves.
template <typename Measure>
std::vector<uint32_t> countStillAndMoving(const Geometry& geometry, const gpu::VoxelGrid& grid,
                                          const Measure& measure) {
    std::vector<bool> still(geometry.triangles.size(), true);
    const std::vector<InstanceRange> runs = movingRuns(geometry);
    for (const InstanceRange& run : runs)
        std::fill_n(still.begin() + run.firstTriangle, run.triangleCount, false);
    std::vector<uint32_t> counts = count(geometry, grid, still, measure);
    if (runs.empty()) return counts;

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

}  // namespace voxray
