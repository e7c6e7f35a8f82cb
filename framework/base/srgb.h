#pragma once

#include <cmath>

namespace voxray {

/// sRGB transfer function (IEC 61966-2-1), linear [0, 1] to display [0, 1].
template <typename Real>
Real srgbEncode(Real linear) {
    return linear <= Real(0.0031308) ? Real(12.92) * linear
                                     : Real(1.055) * std::pow(linear, Real(1 / 2.4)) - Real(0.055);
}

/// Its inverse, display [0, 1] to linear [0, 1].
template <typename Real>
Real srgbDecode(Real display) {
    return display <= Real(0.04045) ? display / Real(12.92)
                                    : std::pow((display + Real(0.055)) / Real(1.055), Real(2.4));
}

}  // namespace voxray
