#pragma once

#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace voxray {

/// Clamps a value of the file to [min, max], with a warning that names it. NaN becomes `min`.
float limited(GltfFile& file, double value, double min, double max, const std::string& what);

/// Reads an array's numbers, each clamped; an empty one keeps the default. @throws Error for another length
template <typename Vector>
void readLimited(GltfFile& file, const std::vector<double>& values, Vector& out, double min, double max,
                 const std::string& what) {
    if (values.empty()) return;
    if (values.size() != size_t(Vector::length()))
        file.fail("{} has {} numbers; expected {}", what, values.size(), int(Vector::length()));
    for (int i = 0; i < int(Vector::length()); ++i) out[i] = limited(file, values[size_t(i)], min, max, what);
}

/// Clamps vertex colours so that the base colour, factor times vertex colour, is 0 to 1. @return number of
/// vertices changed
size_t limitColors(Mesh& mesh, const Material& material);

}  // namespace voxray
