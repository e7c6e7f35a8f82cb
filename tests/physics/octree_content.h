#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "passes/common/dispatch.h"
#include "passes/filter_voxels/octree_builder.h"
#include "passes/filter_voxels/octree_collapse.h"
#include "tests/gpu/chain.h"

namespace voxray::test {

using Faces = std::array<glm::dvec4, 6>;  ///< Premultiplied radiance and opacity for +x -x +y -y +z -z.

/// What shaders/radiance_texel.glsl packs and unpacks.
inline glm::uvec2 packRadiance(const glm::dvec4& value) {
    const double largest = std::max({value.r, value.g, value.b});
    glm::uvec3 mantissa(0);
    int exponent = 0;
    if (largest > 0) {
        std::frexp(largest, &exponent);  // largest < 2^exponent
        for (int c = 0; c < 3; ++c)
            mantissa[c] = std::min(uint32_t(std::ldexp(value[c], 14 - exponent) + 0.5), 16383u);
        exponent += 126;
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
        grid.origin = {-1.25f, 0.5f, 3.0f};
        grid.voxelSize = 0.125f;
        grid.resolution = resolution;
        grid.wordsPerRow = (resolution.x + 31) / 32;
        grid.directions = directions;
        levels.push_back(makeLevel(0, value));
        for (uint32_t level = 1; level <= octreeLevels(resolution); ++level)
            levels.push_back(makeLevel(level, [&](glm::ivec3 cell) { return filtered(level - 1, cell); }));
    }

    bool empty(uint32_t level, glm::ivec3 cell) const {
        for (const glm::dvec4& face : at(level, cell))
            if (face.a > 0) return false;
        return true;
    }
    const Faces& at(uint32_t level, glm::ivec3 cell) const {
        static const Faces nothing{};
        const glm::ivec3 size(octreeCells(grid.resolution, level));
        for (int axis = 0; axis < 3; ++axis)
            if (cell[axis] < 0 || cell[axis] >= size[axis]) return nothing;
        return levels[level][(size_t(cell.z) * size.y + size_t(cell.y)) * size.x + size_t(cell.x)];
    }
    void forEach(uint32_t level, const std::function<void(glm::ivec3)>& visit) const {
        const glm::ivec3 size(octreeCells(grid.resolution, level));
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) visit({x, y, z});
    }

    /// What a sample must answer: trilinear on two levels, linear between them.
    glm::dvec4 sample(glm::dvec3 position, double footprint, glm::dvec3 direction) const {
        const double level =
            std::clamp(std::log2(footprint / grid.voxelSize), 0.0, double(levels.size() - 1));
        const uint32_t fine = std::min(uint32_t(level), uint32_t(levels.size()) - 2);
        return glm::mix(trilinear(position, fine, direction), trilinear(position, fine + 1, direction),
                        level - fine);
    }

    /// The voxels as voxelization leaves them, without materials.
    SurfaceVoxels surfaceVoxels(CommandStream& stream) const {
        SurfaceVoxels voxels;
        voxels.grid = grid;
        std::vector<uint32_t> occupancy(voxels.words(), 0), rank(voxels.words(), 0);
        forEach(0, [&](glm::ivec3 v) {
            if (empty(0, v)) return;
            occupancy[(size_t(v.z) * grid.resolution.y + size_t(v.y)) * grid.wordsPerRow +
                      size_t(v.x) / 32] |= 1u << (v.x % 32);
        });
        for (size_t word = 0; word < occupancy.size(); ++word) {
            rank[word] = voxels.voxelCount;
            voxels.voxelCount += uint32_t(std::popcount(occupancy[word]));
        }
        voxels.occupancy = Buffer(stream.device(), "occupancy", voxels.words() * sizeof(uint32_t));
        voxels.rank = Buffer(stream.device(), "rank", voxels.words() * sizeof(uint32_t));
        stream.upload(voxels.occupancy, occupancy);
        stream.upload(voxels.rank, rank);
        return voxels;
    }

    gpu::VoxelGrid grid{};
    std::vector<std::vector<Faces>> levels;

 private:
    std::vector<Faces> makeLevel(uint32_t level, const std::function<Faces(glm::ivec3)>& value) const {
        std::vector<Faces> result;
        forEach(level, [&](glm::ivec3 cell) { result.push_back(value(cell)); });
        return result;
    }

    Faces filtered(uint32_t finer, glm::ivec3 cell) const {
        Faces result{};
        for (int face = 0; face < 6; ++face) {
            const auto child = [&](int octant) {
                return at(finer, 2 * cell + (glm::ivec3(octant, octant >> 1, octant >> 2) & 1))[size_t(face)];
            };
            const int stride = 1 << face / 2;
            for (int octant = 0; octant < 8; ++octant) {
                if (directions_ == 1) result[size_t(face)] += child(octant) / 8.0;
                if (directions_ == 1 || (octant & stride)) continue;
                const glm::dvec4 front = child(face % 2 == 0 ? octant + stride : octant);
                const glm::dvec4 back = child(face % 2 == 0 ? octant : octant + stride);
                result[size_t(face)] += (front + (1 - front.a) * back) / 4.0;
            }
        }
        return result;
    }

    glm::dvec4 trilinear(glm::dvec3 position, uint32_t level, glm::dvec3 direction) const {
        const glm::dvec3 inLevel =
            (position - glm::dvec3(grid.origin)) / (double(grid.voxelSize) * double(1u << level)) - 0.5;
        const glm::dvec3 first = glm::floor(inLevel), between = inLevel - first;
        glm::dvec4 sum(0.0);
        for (int i = 0; i < 8; ++i) {
            const glm::ivec3 corner = glm::ivec3(i, i >> 1, i >> 2) & 1;
            const Faces& faces = at(level, glm::ivec3(first) + corner);
            const glm::dvec3 w = glm::mix(1.0 - between, between, glm::dvec3(corner));
            if (directions_ == 1) sum += w.x * w.y * w.z * faces[0];
            for (int axis = 0; axis < 3 && directions_ == 6; ++axis)
                sum += w.x * w.y * w.z * direction[axis] * direction[axis] *
                       faces[size_t(2 * axis + (direction[axis] > 0 ? 1 : 0))];
        }
        return sum;
    }

    uint32_t directions_;
};

/// An octree of made-up content, with its arrays read back.
class TestOctree {
 public:
    explicit TestOctree(const Content& content, uint32_t directions = 1)
        : compiler_(VOXRAY_SOURCE_DIR, VOXRAY_TEST_CACHE),
          stream_(device()),
          builder_(device(), compiler_),
          built_(builder_.build(stream_, content.surfaceVoxels(stream_), directions)) {
        const RadianceOctree& tree = octree();
        leaves = stream_.readAs<uint32_t>(built_.leaves, tree.size.nodes[0]);
        std::vector<glm::uvec2> texels(tree.values.bytes() / sizeof(glm::uvec2), glm::uvec2(0));
        for (size_t face = 0; face < directions; ++face)
            for (size_t leaf = 0; leaf < leaves.size(); ++leaf)
                texels[face * tree.size.nodeCount() + tree.first[0] + leaf] =
                    packRadiance(content.at(0, cellOf(leaves[leaf]))[face]);
        stream_.upload(tree.values, texels);
        builder_.filter(stream_, tree);
        refresh();
    }

    /// Collapses uniform nodes.
    void collapse() {
        built_.octree = OctreeCollapse(device(), compiler_).run(stream_, std::move(built_.octree));
        refresh();
    }

    /// The voxel of an entry of `leaves`.
    static glm::ivec3 cellOf(uint32_t word) { return glm::ivec3(word, word >> 10, word >> 20) & 0x3ff; }

    /// As octreeNode() in shaders/octree.glsl, from the root down and without the table.
    uint32_t node(glm::ivec3 cell, uint32_t level) const {
        uint32_t result = 0;
        for (uint32_t l = octree().size.levels(); l-- > level;) {
            const glm::ivec3 at = (cell >> int(l - level)) & 1;
            const uint32_t bit = 8 * (result % 4) + uint32_t(at.x + 2 * at.y + 4 * at.z);
            const glm::uvec2 four = nodes[result / 4];
            if (((four.x >> 8 * (result % 4)) & 0xff) == 0) return result;  // Uniform.
            if (!(four.x >> bit & 1)) return NO_NODE;
            result = four.y + uint32_t(std::popcount(four.x & ((1u << bit) - 1)));
        }
        return result;
    }

    struct Query {
        glm::vec3 position;
        float footprint;
        glm::vec3 direction;
        float reserved = 0;
    };
    struct Answer {
        glm::vec4 radiance;
        float empty;
    };
    /// sampleRadiance() and emptyDistance() on the device.
    std::vector<Answer> sample(const std::vector<Query>& list) {
        const Program program =
            makeComputeProgram(device(), compiler_.compile("tests/gpu/radiance_samples.comp"));
        const Buffer in(device(), "queries", list.size() * sizeof(Query));
        const Buffer out(device(), "answers", list.size() * sizeof(Answer));
        stream_.upload(in, list);
        stream_.dispatch(program, {{"queries", in}, {"answers", out}, {"radianceOctree", octree().header}},
                         uint32_t(list.size()), linearGroups(list.size()));
        return stream_.readAs<Answer>(out, list.size());
    }

    const RadianceOctree& octree() const { return built_.octree; }
    CommandStream& stream() { return stream_; }
    std::vector<uint32_t> leaves, table;
    std::vector<glm::uvec2> nodes, values;

 private:
    void refresh() {
        const RadianceOctree& tree = octree();
        nodes = stream_.readAs<glm::uvec2>(tree.nodes, tree.nodes.bytes() / sizeof(glm::uvec2));
        values = stream_.readAs<glm::uvec2>(tree.values, tree.values.bytes() / sizeof(glm::uvec2));
        table = stream_.readAs<uint32_t>(tree.table, tree.table.bytes() / sizeof(uint32_t));
    }

    ShaderCompiler compiler_;
    CommandStream stream_;
    OctreeBuilder builder_;
    OctreeBuilder::Built built_;
};

}  // namespace voxray::test
