#include "experiment/scene_size.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "base/byte_units.h"
#include "scene/load.h"
#include "trace/gpu_scene.h"

namespace voxray {
namespace {

/// Settings that the number of triangles grows with.
std::vector<std::string> fewerTriangles(const SceneSettings& settings) {
    std::vector<std::string> ways;
    if (settings.options.subdivide > 0) ways.emplace_back("lower scene.subdivide");
    if (!settings.additions.empty()) ways.emplace_back("place fewer copies in scene.add");
    if (settings.movingSpheres && settings.movingSpheres->count > 0)
        ways.emplace_back("lower scene.moving_spheres.count");
    if (settings.source.builtin.empty())
        ways.emplace_back("simplify its meshes");
    else
        for (const ParameterDoc& doc : describeBuiltinScene(settings.source.builtin))
            if (doc.type == "integer") ways.push_back("lower scene." + doc.name);
    return ways;
}

std::vector<std::string> smallerTextures(const SceneSettings& settings, const Scene& scene) {
    const auto texels = [](const Texture& texture) { return uint64_t(texture.width) * texture.height; };
    const Texture& largest = *std::ranges::max_element(scene.textures, {}, texels);
    std::vector<std::string> ways;
    if (!settings.additions.empty()) ways.emplace_back("place fewer copies in scene.add");
    ways.push_back(fmt::format("make its textures smaller; the largest is '{}' of {} x {}", largest.name,
                               largest.width, largest.height));
    return ways;
}

}  // namespace

std::string sceneSizeAdvice(const SceneSettings& settings, const SceneState& state) {
    const Scene& scene = *state.scene;
    const uint64_t textures = gpuTextureBytes(scene), triangles = gpuSceneBytes(state) - textures;
    const uint64_t map = gpuEnvironmentBytes(scene.environment);
    std::vector<std::string> ways;
    if (map > std::max(textures, triangles))
        ways = {"take a smaller map for scene.environment"};
    else if (textures > triangles)
        ways = smallerTextures(settings, scene);
    else
        ways = fewerTriangles(settings);
    ways.emplace_back("take another --device");
    return fmt::format(
        "its {} triangles take {:.1f} MiB, its {} textures {:.1f} MiB, its environment {:.1f} MiB: {}",
        state.geometry.triangles.size(), double(triangles) / kMiB, scene.textures.size(),
        double(textures) / kMiB, double(map) / kMiB, fmt::join(ways, ", or "));
}

}  // namespace voxray
