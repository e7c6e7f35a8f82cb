#pragma once

#include <optional>
#include <span>
#include <string>

#include "config/settings.h"
#include "experiment/checks/diagnostic.h"
#include "graph/graph.h"
#include "scene/geometry.h"

namespace voxray {

/// Foretells how long rays to many lights take, by how fast a few are on this machine's CPU.
class LightRays {
 public:
    /// @param state must outlive this object.
    explicit LightRays(const SceneState& state) : state_(state) {}

    /// Passes, planned, of which one run traces rays to lights for longer than ten seconds, since there are
    /// so many lights.
    void check(std::span<const Graph::PassInfo> passes, Diagnostics& found);

 private:
    double perSecond();

    const SceneState& state_;
    std::optional<double> perSecond_;
};

/// What to change where a scene itself takes too much of the device's memory: what it takes for triangles,
/// for textures and for its environment map, and which settings of the config or parts of its file the
/// largest of these grows with.
std::string sceneSizeAdvice(const SceneSettings& settings, const SceneState& state);

}  // namespace voxray
