#pragma once

#include <optional>
#include <span>
#include <string>

#include "config/settings.h"
#include "experiment/checks/diagnostic.h"
#include "graph/graph.h"
#include "scene/geometry.h"

namespace voxray {

/// Estimates the time of shadow rays to many lights from the speed of a few rays on this machine's CPU.
class ShadowRayCost {
 public:
    /// @param state must outlive this object.
    explicit ShadowRayCost(const SceneState& state) : state_(state) {}

    /// Warns of planned passes that trace rays to lights for longer than ten seconds in each run, because
    /// there are many lights.
    void check(std::span<const Graph::PassInfo> passes, Diagnostics& found);

 private:
    /// Rays in a second, measured once.
    double perSecond();

    const SceneState& state_;
    std::optional<double> perSecond_;
};

/// Advice on a scene that does not fit into the device's memory: the sizes of its triangles, textures and
/// environment map, and how to reduce the largest of these.
std::string sceneSizeAdvice(const SceneSettings& settings, const SceneState& state);

}  // namespace voxray
