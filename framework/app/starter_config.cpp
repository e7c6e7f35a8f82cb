#include "app/starter_config.h"

#include <fmt/format.h>

#include "base/value.h"

namespace voxray {

StarterScene starterScene(const std::string& name, const SceneSource& source, const FirstView& view) {
    const auto quoted = [](const std::string& text) { return Value::fromScalar(text, true).json(-1); };
    return {.name = quoted(name),
            .source = source.builtin.empty() ? "file: " + quoted(source.file) : "builtin: " + source.builtin,
            .camera = yamlOf(view.camera),
            .light = view.light.yaml,
            .exposureStops = view.exposureStops};
}

std::string starterConfig(const StarterScene& scene) {
    return fmt::format(R"(name: {}
scene:
  {}
  {}
  {}
  materials: lambert    # Lookups and gather rays take surfaces as diffuse; without this line the reference has the gloss, too
image: {{width: 320, height: 180{}}}
graph:
  - {{pass: gbuffer, samples_per_pixel_edge: 2}}
  - {{pass: voxelize, resolution: 128}}
  - {{pass: inject_light_rays, id: inject, rays_per_light: 2097152, bounces: 7}}
  - {{pass: gather_irradiance, id: indirect}}
  - {{pass: direct_shadow_rays}}
  - {{pass: composite}}
reference: {{pass: path_trace, spp: 256, bounces: 8}}
sweep:
  indirect:
    lookup: [{{pass: inject_light_rays, rays_per_light: 2097152, bounces: 8}}, gather_irradiance]
    rays: [{{pass: trace_gather_rays, rays_per_block: 64, block: 4}}, gather_rays, filter_irradiance]
    paths, 1 sample: [{{pass: path_trace, spp: 1, light: indirect}}, filter_irradiance]
    paths, 4: [{{pass: path_trace, spp: 4, light: indirect}}, filter_irradiance]
    paths, 16: [{{pass: path_trace, spp: 16, light: indirect}}, filter_irradiance]
measure: {{frames: 3, warmup: 1, second_seed: true}}
)",
                       scene.name, scene.source, scene.camera,
                       scene.light.empty() ? "# Its own lights are seen" : scene.light,
                       scene.exposureStops == 0 ? "" : fmt::format(", exposure_stops: {}", scene.exposureStops));
}

}  // namespace voxray
