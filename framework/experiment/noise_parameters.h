#pragma once

#include <string>
#include <vector>

#include "config/sweep.h"
#include "graph/registry.h"

namespace voxray {

/// The parameters of a variant's passes whose larger values lower the noise of an image, "<id>.<parameter>",
/// in the order of the graph; without those that other parameters leave no effect. Empty: the image has no
/// such noise.
/// @param port the image, "final" or "indirect".
std::vector<std::string> noiseParameters(const Variant& variant, const Registry& registry,
                                         const std::string& port);

}  // namespace voxray
