#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "passes/common/octree/octree_builder.h"
#include "passes/cones/filter_voxels/svo_collapse.h"
#include "tests/gpu/radiance_samples.h"
#include "tests/physics/made_up_voxels.h"
#include "tests/support/kept.h"

namespace voxray::test {

using Faces = std::array<glm::dvec4, 6>;  ///< Premultiplied radiance and opacity for +x -x +y -y +z -z.

/// What passes/cones/radiance/radiance_texel.glsl packs and unpacks.
inline glm::uvec2 packRadiance(const glm::dvec4& value) {
    const double largest = std::max({value.r, value.g, value.b});
    glm::uvec3 mantissa(0);
    int exponent = 0;
    if (largest > 0) {
        std::frexp(largest, &exponent);  // largest < 2^exponent
        for (int c = 0; c < 3; ++c) mantissa[c] = std::min(uint32_t(std::ldexp(value[c], 14 - exponent) + 0.5), 16383u);
        exponent += 126 - 13;
    }
    const uint32_t opacity = uint32_t(value.a * 16383 + 0.5);
    return {mantissa.r | mantissa.g << 14 | mantissa.b << 28,
            mantissa.b >> 4 | uint32_t(exponent) << 10 | opacity << 18};
}

/// Voxels made up by a test, and the same content as a dense pyramid of doubles: what sampling must give.
class Content {
 public:
    /// `value` of a voxel; nothing where all six opacities are 0. Directions: 1 (the first counts) or 6.
    Content(glm::uvec3 resolution, uint32_t directions, const std::function<Faces(glm::ivec3)>& value)
        : directions_(directions) {
        grid = madeUpGrid(resolution, 0.125f);
        grid.directions = directions;
        levels.push_back(makeLevel(0, value));
        for (uint32_t level = 1; level < gridLevels(resolution); ++level)
            levels.push_back(makeLevel(level, [&](glm::ivec3 cell) { return filtered(level - 1, cell); }));
    }

    bool empty(uint32_t level, glm::ivec3 cell) const {
        for (const glm::dvec4& face : at(level, cell))
            if (face.a > 0) return false;
        return true;
    }
    const Faces& at(uint32_t level, glm::ivec3 cell) const {
        static const Faces nothing{};
        const glm::ivec3 size(levelResolution(grid.resolution, level));
        for (int axis = 0; axis < 3; ++axis)
            if (cell[axis] < 0 || cell[axis] >= size[axis]) return nothing;
        return levels[level][(size_t(cell.z) * size.y + size_t(cell.y)) * size.x + size_t(cell.x)];
    }
    void forEach(uint32_t level, const std::function<void(glm::ivec3)>& visit) const {
        const glm::ivec3 size(levelResolution(grid.resolution, level));
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) visit({x, y, z});
    }

    /// What sampleRadiance() must answer: passes/cones/radiance/sample_radiance.glsl, in doubles.
    glm::dvec4 sample(glm::dvec3 position, double footprint, glm::dvec3 direction) const {
        const double voxel = grid.voxelSize;
        const double level = std::clamp(std::log2(footprint / voxel), 0.0, double(levels.size() - 1));
        const uint32_t finer = uint32_t(level);
        glm::dvec4 met =
            trilinear(position, finer, direction) * (1 - (level - finer)) * (footprint / voxel / double(1u << finer));
        if (level > finer)
            met +=
                trilinear(position, finer + 1, direction) * (level - finer) * (footprint / voxel / double(2u << finer));
        return met;
    }

    SurfaceVoxels surfaceVoxels(CommandStream& stream) const {
        return madeUpVoxels(stream, grid, [&](glm::ivec3 v) { return !empty(0, v); });
    }

    gpu::VoxelGrid grid{};
    std::vector<std::vector<Faces>> levels;

 private:
    std::vector<Faces> makeLevel(uint32_t level, const std::function<Faces(glm::ivec3)>& value) const {
        std::vector<Faces> result;
        forEach(level, [&](glm::ivec3 cell) { result.push_back(value(cell)); });
        return result;
    }

    /// Two voxels in a row: what has no room next to the front one is hidden.
    static glm::dvec4 compositePair(const glm::dvec4& front, const glm::dvec4& rear) {
        return front + rear * (rear.a > 0 ? std::clamp((1 - front.a) / rear.a, 0.0, 1.0) : 0.0);
    }
    static glm::ivec3 offset(int octant) { return glm::ivec3(octant, octant >> 1, octant >> 2) & 1; }
    /// Whether an octant is on the side that a face looks to.
    static bool isFront(int face, int octant) { return offset(octant)[face / 2] == 1 - face % 2; }

    Faces filtered(uint32_t finer, glm::ivec3 cell) const {
        Faces result{};
        for (int face = 0; face < 6; ++face)
            for (int octant = 0; octant < 8; ++octant) {
                const auto child = [&](int o) { return at(finer, 2 * cell + offset(o))[size_t(face)]; };
                if (directions_ == 1) result[size_t(face)] += child(octant) / 8.0;
                if (directions_ == 6 && isFront(face, octant))
                    result[size_t(face)] += compositePair(child(octant), child(octant ^ 1 << face / 2)) / 4.0;
            }
        return result;
    }

    glm::dvec4 trilinear(glm::dvec3 position, uint32_t level, glm::dvec3 direction) const {
        const double side = double(grid.voxelSize) * double(1u << level);
        const glm::dvec3 inLevel = glm::round(((position - glm::dvec3(grid.origin)) / side - 0.5) * 1024.0) / 1024.0;
        const glm::dvec3 first = glm::floor(inLevel), between = inLevel - first;
        const auto weight = [&](int octant) {
            const glm::dvec3 w = glm::mix(1.0 - between, between, glm::dvec3(offset(octant)));
            return w.x * w.y * w.z;
        };
        const auto value = [&](int octant, int face) {
            return weight(octant) > 0 ? at(level, glm::ivec3(first) + offset(octant))[size_t(face)] : glm::dvec4(0.0);
        };
        glm::dvec4 sum(0.0);
        for (int axis = 0; axis < (directions_ == 1 ? 1 : 3); ++axis)
            for (int octant = 0; octant < 8; ++octant) {
                const int face = 2 * axis + (direction[axis] > 0 ? 1 : 0), rear = octant ^ 1 << axis;
                if (directions_ == 1) sum += weight(octant) * value(octant, 0);
                if (directions_ == 1 || !isFront(face, octant)) continue;
                const glm::dvec4 front = value(octant, face);
                sum += std::abs(direction[axis]) *
                       (weight(octant) * front + weight(rear) * (compositePair(front, value(rear, face)) - front));
            }
        return sum;
    }

    uint32_t directions_;
};

/// An octree of made-up content, with its arrays read back.
class TestOctree {
 public:
    explicit TestOctree(const Content& content, uint32_t directions = 1) : stream_(device()) {
        const gpu::VoxelGrid& g = content.grid;
        radiance.layout = RadianceLayout::Svo;
        radiance.grid = {g.origin, g.voxelSize, g.resolution, gridLevels(g.resolution), directions, 1.0f};
        allocateSvoValues(stream_, tools().builder.build(stream_, content.surfaceVoxels(stream_)), radiance);
        size = radiance.octree.size;
        first = size.first();
        leaves = stream_.readAs<uint32_t>(radiance.octree.leafVoxels, size.nodes[0]);
        std::vector<glm::uvec2> texels(radiance.storage[0].bytes() / sizeof(glm::uvec2), glm::uvec2(0));
        for (size_t face = 0; face < directions; ++face)
            for (size_t leaf = 0; leaf < leaves.size(); ++leaf)
                texels[face * size.nodeCount() + first[0] + leaf] =
                    packRadiance(content.at(0, cellOf(leaves[leaf]))[face]);
        stream_.upload(radiance.storage[0], texels);
        changed_ = Buffer(device(), "changed", SvoFilter::changedBytes(size));
        stream_.fill(changed_, ~0u);
        tools().filter.run(stream_, radiance, changed_);
        refresh();
    }

    /// Gives one voxel another value and filters what that touches. @return nodes with a new value.
    uint32_t change(glm::ivec3 voxel, const Faces& value) {
        const uint32_t leaf = node(voxel, 0);
        std::vector<uint32_t> bits(changed_.bytes() / sizeof(uint32_t), 0);
        bits[leaf / 32] |= 1u << leaf % 32;
        stream_.upload(changed_, bits);
        for (size_t face = 0; face < radiance.grid.directions; ++face) {
            const glm::uvec2 texel = packRadiance(value[face]);
            stream_.upload(radiance.storage[0], std::as_bytes(std::span(&texel, 1)),
                           (face * size.nodeCount() + leaf) * sizeof(texel));
        }
        tools().filter.run(stream_, radiance, changed_);
        refresh();
        uint32_t count = 0;
        for (const uint32_t word : stream_.readAs<uint32_t>(changed_, bits.size()))
            count += uint32_t(std::popcount(word));
        return count;
    }

    /// Collapses uniform nodes.
    void collapse() {
        tools().collapse.run(stream_, radiance);
        size = radiance.octree.size;
        first = size.first();
        refresh();
    }

    uint64_t bytes() const {
        const Octree& octree = radiance.octree;
        return octree.header.bytes() + octree.table.bytes() + octree.nodes.bytes() + radiance.header.bytes() +
               radiance.storage[0].bytes();
    }

    /// The voxel of an entry of `leaves`.
    static glm::ivec3 cellOf(uint32_t word) { return glm::ivec3(word, word >> 10, word >> 20) & 0x3ff; }

    /// Number of a voxel's node, from the root down and without the table.
    uint32_t node(glm::ivec3 voxel, uint32_t level) const {
        uint32_t number = 1;
        for (uint32_t l = size.levels() - 1; l-- > level && number != NO_NODE;) {
            const glm::ivec3 at = (voxel >> int(l - level)) & 1;
            const uint32_t word = nodes[number], mask = word & 0xff, bit = 1u << (at.x + 2 * at.y + 4 * at.z);
            if (mask == 0) return number;  // Uniform.
            number = mask & bit ? (word >> 8) + uint32_t(std::popcount(mask & (bit - 1))) : NO_NODE;
        }
        return number;
    }

    std::vector<glm::vec4> sample(const std::vector<RadianceQuery>& queries) const {
        return sampleRadiance(radiance, queries);
    }

    /// octreeLeaf() and startLevel() on the device.
    std::vector<glm::uvec2> lookUp(const std::vector<glm::ivec3>& voxels) {
        TestPrograms programs;
        const Kernel kernel(programs, "tests/gpu/octree_lookup.comp", radiance.defines());
        programs.compile();
        const Buffer in(device(), "queries", voxels.size() * sizeof(glm::ivec3));
        const Buffer out(device(), "answers", voxels.size() * sizeof(glm::uvec2));
        stream_.upload(in, voxels);
        stream_.dispatch(kernel, voxels.size(),
                         {radiance,
                          {"queries", in},
                          {"answers", out},
                          {"count", uint32_t(voxels.size())},
                          {"firstLeaf", first.front()}});
        return stream_.readAs<glm::uvec2>(out, voxels.size());
    }

    RadianceVoxels radiance;
    OctreeSize size;
    std::vector<uint32_t> first, leaves, table, nodes;
    std::vector<glm::uvec2> values;

 private:
    void refresh() {
        const auto read = [&]<typename T>(std::vector<T>& into, const Buffer& buffer) {
            into = stream_.readAs<T>(buffer, buffer.bytes() / sizeof(T));
        };
        read(table, radiance.octree.table);
        read(nodes, radiance.octree.nodes);
        read(values, radiance.storage[0]);
    }

    // Programs take longer to make than these octrees.
    struct Tools : TestPrograms {
        Tools() { compile(); }
        const OctreeBuilder builder{*this};
        const SvoFilter filter{*this};
        const SvoCollapse collapse{*this};
    };
    static const Tools& tools() {
        static const Tools& shared = *kept(std::make_shared<Tools>());
        return shared;
    }

    CommandStream stream_;
    Buffer changed_;
};

}  // namespace voxray::test
