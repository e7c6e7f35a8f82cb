#pragma once

#include <vector>

namespace voxray {

/// Mean of Schlick's weight over a Lambert lobe, for SCHLICK_TABLE_SIZE viewers whose cosines have evenly
/// spaced square roots from 0 to 1: the integral of (1 - o·h)^5 over the cosine-weighted hemisphere, h the
/// half vector of the viewer's direction o and the light's. In [0, 1]. One minus it is the fraction that the
/// layer transmits for F0 = 0 and F90 = 1 (glTF 2.0, appendix B.2).
std::vector<float> schlickTable();

}  // namespace voxray
