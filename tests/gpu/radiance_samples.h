#pragma once

#include <random>
#include <string>
#include <vector>

#include "passes/cones/radiance/radiance_voxels.h"
#include "shaders/voxels/voxel_types.h"
#include "tests/gpu/chain.h"
#include "tests/support/programs.h"

namespace voxray::test {

inline const RadianceVoxels& radiance(const Chain& chain) {
    return chain.get<RadianceVoxels>("radiance");
}

/// A question to radiance voxels, as passes/cones/radiance/radiance_voxels.glsl takes it.
struct RadianceQuery {
    glm::vec3 position;  ///< m
    float footprint;     ///< m
    glm::vec3 direction;
    float reserved = 0;
};

/// Places in a grid and a tenth of it around; footprints from half a voxel to twice the root.
inline std::vector<RadianceQuery> randomQueries(const gpu::VoxelGrid& grid, size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::normal_distribution<float> normal;
    std::vector<RadianceQuery> list(count);
    const glm::vec3 extent = glm::vec3(grid.resolution) * grid.voxelSize;
    for (RadianceQuery& q : list) {
        for (int axis = 0; axis < 3; ++axis)
            q.position[axis] = grid.origin[axis] + extent[axis] * (1.2f * uniform(random) - 0.1f);
        q.footprint = grid.voxelSize * std::exp2(-1 + float(gridLevels(grid.resolution) + 1) * uniform(random));
        q.direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    }
    return list;
}

/// What sampleRadiance() answers, one by one. Works for every layout.
inline std::vector<glm::vec4> sampleRadiance(const RadianceVoxels& radiance,
                                             const std::vector<RadianceQuery>& queries) {
    TestPrograms programs;
    const Kernel kernel(programs, "radiance_samples.comp", radiance.defines());
    programs.compile();
    CommandStream stream(device());
    const Buffer input(device(), "queries", queries.size() * sizeof(RadianceQuery));
    const Buffer output(device(), "answers", queries.size() * sizeof(glm::vec4));
    stream.upload(input, queries);
    stream.dispatch(kernel, queries.size(),
                    {radiance, {"queries", input}, {"answers", output}, {"count", uint32_t(queries.size())}});
    return stream.readAs<glm::vec4>(output, queries.size());
}
inline std::vector<glm::vec4> sampleRadiance(const Chain& chain, const std::vector<RadianceQuery>& queries) {
    return sampleRadiance(radiance(chain), queries);
}

/// Samples everywhere in voxels with one direction.
inline std::vector<glm::vec4> samplesOf(const Chain& chain) {
    const gpu::RadianceGrid& g = radiance(chain).grid;
    return sampleRadiance(chain, randomQueries({g.origin, g.voxelSize, g.resolution, 0, 1, 1024, {}, 0}, 20000));
}

/// All that a layout stores, in one buffer or a texture, as words.
inline std::vector<uint32_t> radianceContent(const RadianceVoxels& radiance) {
    CommandStream stream(device());
    if (!radiance.texture) return stream.readAs<uint32_t>(radiance.storage.at(0), radiance.storage[0].bytes() / 4);
    const uint64_t bytes = imageBytes(radiance.texture.desc());
    const Buffer texels(device(), "texels", bytes, MemoryKind::Readback);
    stream.copy(radiance.texture, texels);
    return stream.readAs<uint32_t>(texels, bytes / 4);
}

}  // namespace voxray::test
