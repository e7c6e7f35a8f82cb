#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "graph/graph.h"
#include "scene/geometry.h"

namespace voxray {

/// Foretells how long rays to many lights take, by how fast a few are on this machine's CPU.
class LightCost {
 public:
    /// @param state must outlive this object.
    explicit LightCost(const SceneState& state) : state_(state) {}

    /// What to say, with file and line, of passes of which one run traces rays to lights for longer than ten
    /// seconds, since there are so many lights. The passes are planned.
    std::vector<std::string> warnings(std::span<const Graph::PassInfo> passes);

 private:
    double raysPerSecond();

    const SceneState& state_;
    std::optional<double> raysPerSecond_;
};

}  // namespace voxray
