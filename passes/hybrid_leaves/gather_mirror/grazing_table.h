#pragma once

#include <vector>

namespace voxray {

/// Means of Schlick's weight over what a Lambert lobe reflects: for each of GRAZING_COSINES viewers, at roots
/// of the cosine evenly spaced from 0 to 1, the integral of (1 - o·h)^5 over the cosine-weighted hemisphere,
/// h the half vector between the viewer's direction o and the light's. Between 0 and 1. 1 less it, for F0 = 0
/// and F90 = 1, is left to the lobe (glTF 2.0, appendix B.2: the dielectric's layer).
std::vector<float> grazingTable();

}  // namespace voxray
