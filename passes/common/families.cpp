#include "passes/common/families.h"

#include <string>

#include "passes/path_trace/path_tracer.h"

namespace voxray {

void registerPasses(Registry& registry) {
    for (const Family& family : kFamilies) {
        const std::string folder(family.folder);
        addRegistered(registry, "passes/" + folder + "/", folder);
    }
    registry.preview = [](const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                          uint32_t width, uint32_t height, uint32_t spp, uint32_t bounces) {
        const PathTraceOptions options{
            .width = width, .height = height, .spp = spp, .bounces = bounces, .rays = ExpectedRays::Few};
        return pathTrace(state, tracer, camera, options).total;
    };
}

}  // namespace voxray
