#pragma once

#include <vector>

#include "passes/common/voxel_march/voxel_march.h"
#include "tests/gpu/prepared.h"
#include "trace/embree_scene.h"

namespace voxray::test {

/// Two points of surfaces, with the unit normals of the sides that face each other.
struct SurfacePair {
    glm::vec3 a, normalA, b, normalB;
};

/// Whether voxels hide a pair's points from each other, and the part of the way that is looked at; both ends
/// are the pair's first point where there is none.
struct BetweenVoxels {
    uint32_t isHidden;  ///< 1 or 0.
    glm::vec3 from, to;
};

inline std::vector<BetweenVoxels> betweenVoxels(const SurfaceVoxels& voxels, const std::vector<SurfacePair>& pairs) {
    CommandStream stream(device());
    TestPrograms programs;
    VoxelMarch march(programs, VoxelTraversal::Bricks);
    const Kernel kernel(programs, "between_surfaces.comp", march.defines());
    prepare(programs, march, voxels);
    march.begin(stream, voxels);
    const Buffer in(device(), "pairs", pairs.size() * sizeof(SurfacePair)),
        out(device(), "answers", pairs.size() * sizeof(BetweenVoxels));
    stream.upload(in, pairs);
    stream.dispatch(kernel, pairs.size(),
                    {march, {"pairs", in}, {"answers", out}, {"grid", voxels.grid}, {"count", uint32_t(pairs.size())}});
    return stream.readAs<BetweenVoxels>(out, pairs.size());
}

/// Whether voxels hide the points of each pair from each other: 1 or 0.
inline std::vector<uint32_t> hiddenByVoxels(const SurfaceVoxels& voxels, const std::vector<SurfacePair>& pairs) {
    std::vector<uint32_t> hidden;
    for (const BetweenVoxels& between : betweenVoxels(voxels, pairs)) hidden.push_back(between.isHidden);
    return hidden;
}

/// Whether triangles do.
inline std::vector<uint32_t> hiddenByTriangles(const SceneState& scene, const std::vector<SurfacePair>& pairs) {
    const EmbreeScene embree(scene);
    std::vector<uint32_t> hidden;
    for (const SurfacePair& p : pairs) {
        const glm::vec3 from = p.a + 1e-4f * p.normalA, to = p.b + 1e-4f * p.normalB;
        hidden.push_back(embree.occluded({from, 0, to - from, 1}));
    }
    return hidden;
}

}  // namespace voxray::test
