#pragma once

#include <string>
#include <vector>

#include "passes/common/dispatch.h"
#include "passes/common/radiance_voxels.h"
#include "tests/gpu/chain.h"

namespace voxray::test {

/// A question to radiance voxels, as shaders/radiance_voxels.glsl takes it.
struct RadianceQuery {
    glm::vec3 position;  ///< m
    float footprint;     ///< m
    glm::vec3 direction;
    float reserved = 0;
};

/// What sampleRadiance() answers, one by one. Works for every layout.
inline std::vector<glm::vec4> sampleRadiance(const RadianceVoxels& radiance,
                                             const std::vector<RadianceQuery>& queries) {
    const ShaderCompiler compiler(VOXRAY_SOURCE_DIR, VOXRAY_TEST_CACHE);
    const Program program =
        makeComputeProgram(device(), compiler.compile("tests/gpu/radiance_samples.comp", radiance.defines()));
    CommandStream stream(device());
    const Buffer input(device(), "queries", queries.size() * sizeof(RadianceQuery));
    const Buffer output(device(), "answers", queries.size() * sizeof(glm::vec4));
    stream.upload(input, queries);
    std::vector<Binding> bindings = radiance.bindings();
    bindings.emplace_back("queries", input);
    bindings.emplace_back("answers", output);
    stream.dispatch(program, bindings, uint32_t(queries.size()), linearGroups(queries.size()));
    return stream.readAs<glm::vec4>(output, queries.size());
}

}  // namespace voxray::test
