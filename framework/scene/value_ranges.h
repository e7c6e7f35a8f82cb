#pragma once

#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace voxray {

/// A value of the file that has a range: itself within [min, max], else the nearest bound with a warning that
/// names it. What is not a number is taken as `min`.
float limited(GltfFile& file, double value, double min, double max, const std::string& what);

/// An array's numbers, each limited; an empty one keeps the default. @throws Error for another length
template <typename Vector>
void readLimited(GltfFile& file, const std::vector<double>& values, Vector& out, double min, double max,
                 const std::string& what) {
    if (values.empty()) return;
    if (values.size() != size_t(Vector::length()))
        file.fail("{} has {} numbers; expected {}", what, values.size(), int(Vector::length()));
    for (int i = 0; i < int(Vector::length()); ++i) out[i] = limited(file, values[size_t(i)], min, max, what);
}

/// Limits vertex colours so that the base colour, factor times vertex colour, is from 0 to 1; so it is with a
/// texture, too. @return how many vertices had another
size_t limitColors(Mesh& mesh, const Material& material);

}  // namespace voxray
