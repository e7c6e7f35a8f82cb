#pragma once

#include <cstdint>
#include <functional>

#include "image/image.h"
#include "scene/geometry.h"

namespace voxray {

class EmbreeScene;

/// Path traces a small image of a camera's view on the host: `spp` paths a pixel, of up to `bounces`
/// bounces. 3 channels, W/(m² sr).
using Preview = std::function<ImageF(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                                     uint32_t width, uint32_t height, uint32_t spp, uint32_t bounces)>;

}  // namespace voxray
