#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/srgb.h"
#include "image/flip_tone.h"
#include "image/metrics.h"
#include "image/plane.h"

/// FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for
/// Alternating Images", 2020; HDR-FLIP: Andersson, Nilsson, Shirley, Akenine-Möller, "Visualizing Errors in
/// Rendered High Dynamic Range Images", 2021. The error combines a colour pipeline and a feature pipeline.
namespace voxray {

namespace {

constexpr double pi = std::numbers::pi;

// Constants of the 2020 paper, with its symbols.
constexpr double colourExponent = 0.7;    // q_c
constexpr double colourKnee = 0.4;        // p_c
constexpr double colourKneeValue = 0.95;  // p_t
constexpr double featureWidth = 0.082;    // w, degrees
constexpr double featureExponent = 0.5;   // q_f

using Planes = std::array<Plane, 3>;

// Linear Rec.709 to CIE XYZ, and the XYZ of white, that colours are measured against.
const glm::dmat3 xyzFromRgb(glm::dvec3(10135552. / 24577794, 2613072. / 12288897, 1425312. / 73733382),
                            glm::dvec3(8788810. / 24577794, 8788810. / 12288897, 8788810. / 73733382),
                            glm::dvec3(4435075. / 24577794, 887015. / 12288897, 70074185. / 73733382));
const glm::dvec3 white = xyzFromRgb * glm::dvec3(1);
const glm::dmat3 rgbFromXyz = glm::inverse(xyzFromRgb);

// Opponent colours (Y, Cx, Cz), linear in RGB.
glm::dvec3 opponentFromRgb(const glm::dvec3& rgb) {
    const glm::dvec3 t = xyzFromRgb * rgb / white;
    return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}
glm::dvec3 rgbFromOpponent(const glm::dvec3& opponent) {
    const double y = (opponent.x + 16) / 116;
    return rgbFromXyz * (glm::dvec3(y + opponent.y / 500, y, y - opponent.z / 200) * white);
}

// CIELab, its chroma scaled by lightness (the Hunt effect).
double labCurve(double t) {
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}
glm::dvec3 huntLabFromRgb(const glm::dvec3& rgb) {
    const glm::dvec3 t = xyzFromRgb * rgb / white;
    const glm::dvec3 f(labCurve(t.x), labCurve(t.y), labCurve(t.z));
    const double lightness = 116 * f.y - 16;
    return {lightness, 0.01 * lightness * 500 * (f.x - f.y), 0.01 * lightness * 200 * (f.y - f.z)};
}

// Distance of large colour differences: city block in lightness, Euclidean in chroma.
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

// A contrast sensitivity filter of one opponent channel: a sum of separable Gaussians, of total weight 1.
struct Sensitivity {
    struct Term {
        double weight;
        Kernel kernel;
    };
    std::vector<Term> terms;
};

// Terms a sqrt(π/b) exp(-π² x² / b), x in degrees.
struct SensitivityTerm {
    double a, b;
};
Sensitivity sensitivity(std::span<const SensitivityTerm> terms, double pixelsPerDegree) {
    // All channels share the radius of the widest Gaussian, b = 0.04.
    const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixelsPerDegree));
    Sensitivity filter;
    double total = 0;
    for (const auto& [a, b] : terms) {
        const double sigma = std::sqrt(b / (2 * pi * pi)) * pixelsPerDegree;
        double sum = 0;
        for (int x = -radius; x <= radius; ++x) sum += std::exp(-double(x) * x / (2 * sigma * sigma));

        // Weights beyond 8 sigma are below 1e-13.
        const int reach = std::min(radius, int(std::ceil(8 * sigma)));
        filter.terms.push_back({a * std::sqrt(pi / b) * sum * sum, gaussianKernel(sigma, reach)});
        total += filter.terms.back().weight;
    }
    for (Sensitivity::Term& term : filter.terms) term.weight /= total;
    return filter;
}

Plane apply(const Sensitivity& filter, const Plane& in) {
    Plane out(in.width, in.height);
    for (const Sensitivity::Term& term : filter.terms) {
        const Plane blurred = filterY(filterX(in, term.kernel), term.kernel);
        parallelRows(out.height, [&](size_t y) {
            for (size_t x = 0; x < out.width; ++x) out.row(y)[x] += term.weight * blurred.row(y)[x];
        });
    }
    return out;
}

// Scales positive weights to sum to 1 and negative ones to sum to -1.
void balance(Kernel& kernel) {
    double positive = 0, negative = 0;
    for (const double weight : kernel) (weight > 0 ? positive : negative) += std::abs(weight);
    for (double& weight : kernel) weight /= weight > 0 ? positive : negative;
}

// All filters at one viewing distance.
struct Filters {
    std::array<Sensitivity, 3> sensitivities;  // Y, Cx, Cz
    Kernel gauss, edge, point;

    explicit Filters(double pixelsPerDegree) {
        if (!(pixelsPerDegree > 0 && pixelsPerDegree <= 1000))
            throw Error("FLIP works with 0 to 1000 pixels per degree, not {}", pixelsPerDegree);

        // Contrast sensitivity of the achromatic, red-green and blue-yellow channels.
        const SensitivityTerm achromatic[] = {{1, 0.0047}}, redGreen[] = {{1, 0.0053}};
        const SensitivityTerm blueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
        sensitivities = {sensitivity(achromatic, pixelsPerDegree), sensitivity(redGreen, pixelsPerDegree),
                         sensitivity(blueYellow, pixelsPerDegree)};

        // First and second derivatives of a Gaussian, from trough to peak w wide.
        const double sigma = 0.5 * featureWidth * pixelsPerDegree;
        const int radius = int(std::ceil(3 * sigma));
        gauss = gaussianKernel(sigma, radius);
        edge = point = gauss;
        for (int x = -radius; x <= radius; ++x) {
            edge[size_t(x + radius)] *= -x;
            point[size_t(x + radius)] *= double(x) * x / (sigma * sigma) - 1;
        }
        balance(edge);
        balance(point);
    }
};

// An image after the two pipelines.
struct FilteredImage {
    Planes colour;      // Filtered, in Hunt-adjusted Lab
    Plane edge, point;  // Strength of edges and points
};

// Magnitude of the gradient by a derivative kernel.
Plane strength(const Plane& alongX, const Plane& alongY) {
    Plane out(alongX.width, alongX.height);
    parallelRows(out.height, [&](size_t y) {
        for (size_t x = 0; x < out.width; ++x) {
            const double dx = alongX.row(y)[x], dy = alongY.row(y)[x];
            out.row(y)[x] = std::sqrt(dx * dx + dy * dy);
        }
    });
    return out;
}

// @param linearRgb(x, y) is the linear display colour of a pixel, in [0, 1].
template <typename LinearRgb>
FilteredImage filterImage(uint32_t width, uint32_t height, const Filters& filters, const LinearRgb& linearRgb) {
    Planes opponent = {Plane(width, height), Plane(width, height), Plane(width, height)};
    parallelRows(height, [&](size_t y) {
        for (size_t x = 0; x < width; ++x) {
            const glm::dvec3 colour = opponentFromRgb(linearRgb(x, y));
            for (int c = 0; c < 3; ++c) opponent[size_t(c)].row(y)[x] = colour[c];
        }
    });

    // Colour: filtered by contrast sensitivity, clamped to the gamut, in a perceptually uniform space.
    FilteredImage result;
    for (size_t c = 0; c < 3; ++c) result.colour[c] = apply(filters.sensitivities[c], opponent[c]);
    parallelRows(height, [&](size_t y) {
        for (size_t x = 0; x < width; ++x) {
            const glm::dvec3 filtered(result.colour[0].row(y)[x], result.colour[1].row(y)[x],
                                      result.colour[2].row(y)[x]);
            const glm::dvec3 rgb = glm::clamp(rgbFromOpponent(filtered), 0.0, 1.0);
            const glm::dvec3 lab = huntLabFromRgb(rgb);
            for (int c = 0; c < 3; ++c) result.colour[size_t(c)].row(y)[x] = lab[c];
        }
    });

    // Features: edges and points of the achromatic channel, scaled to [0, 1].
    Plane& grey = opponent[0];
    for (double& value : grey.data) value = (value + 16) / 116;
    const Plane blurredX = filterX(grey, filters.gauss);
    result.edge = strength(filterY(filterX(grey, filters.edge), filters.gauss), filterY(blurredX, filters.edge));
    result.point = strength(filterY(filterX(grey, filters.point), filters.gauss), filterY(blurredX, filters.point));
    return result;
}

// Error of each pixel from the filtered images.
Plane difference(const FilteredImage& test, const FilteredImage& reference) {
    const double largest = std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), colourExponent);
    const double knee = colourKnee * largest;
    Plane out(test.edge.width, test.edge.height);
    parallelRows(out.height, [&](size_t y) {
        const auto colourAt = [y](const FilteredImage& image, size_t x) {
            return glm::dvec3(image.colour[0].row(y)[x], image.colour[1].row(y)[x], image.colour[2].row(y)[x]);
        };
        for (size_t x = 0; x < out.width; ++x) {
            // Colour difference, small ones mapped to [0, 0.95].
            const double distance = std::pow(hyab(colourAt(test, x), colourAt(reference, x)), colourExponent);
            const double colour = distance < knee
                                      ? distance / knee * colourKneeValue
                                      : colourKneeValue + (distance - knee) / (largest - knee) * (1 - colourKneeValue);

            // Feature difference amplifies it.
            const double feature = std::max(std::abs(test.edge.row(y)[x] - reference.edge.row(y)[x]),
                                            std::abs(test.point.row(y)[x] - reference.point.row(y)[x]));
            const double amplifier = std::pow(std::numbers::sqrt2 / 2 * feature, featureExponent);
            out.row(y)[x] = std::clamp(std::pow(colour, 1 - amplifier), 0.0, 1.0);
        }
    });
    return out;
}

ErrorMap errorMapOf(const Plane& plane) {
    ErrorMap error;
    error.map = ImageF(plane.width, plane.height, 1);
    std::copy(plane.data.begin(), plane.data.end(), error.map.data.begin());
    const double sum = sumRows(plane.height, [&](size_t y) {
        double rowSum = 0;
        for (size_t x = 0; x < plane.width; ++x) rowSum += plane.row(y)[x];
        return rowSum;
    });
    error.mean = sum / double(plane.data.size());
    return error;
}

}  // namespace

ErrorMap flipLdr(const ImageF& testDisplay, const ImageF& referenceDisplay, double pixelsPerDegree) {
    checkPair(testDisplay, referenceDisplay);
    const Filters filters(pixelsPerDegree);
    const auto filter = [&](const ImageF& image) {
        return filterImage(image.width, image.height, filters, [&](size_t x, size_t y) {
            const float* p = image.pixel(uint32_t(x), uint32_t(y));
            const glm::dvec3 display = glm::clamp(glm::dvec3(p[0], p[1], p[2]), 0.0, 1.0);
            return glm::dvec3(srgbDecode(display.x), srgbDecode(display.y), srgbDecode(display.z));
        });
    };
    return errorMapOf(difference(filter(testDisplay), filter(referenceDisplay)));
}

ErrorMap flipHdr(const ImageF& test, const ImageF& reference, const FlipExposures& exposures, double pixelsPerDegree) {
    checkPair(test, reference);
    if (exposures.count < 1 || !(exposures.start <= exposures.stop) || !std::isfinite(exposures.start) ||
        !std::isfinite(std::exp2(exposures.stop)))
        throw Error("FLIP cannot use {} exposures from {} to {} stops", exposures.count, exposures.start,
                    exposures.stop);
    const Filters filters(pixelsPerDegree);

    // Maximum error of each pixel; equal exposures are evaluated once.
    const int count = exposures.start == exposures.stop ? 1 : exposures.count;
    const double step = (exposures.stop - exposures.start) / std::max(count - 1, 1);
    Plane largest(reference.width, reference.height);
    for (int i = 0; i < count; ++i) {
        if (interruptRequested()) throw Interrupted();
        const double scale = std::exp2(exposures.start + i * step);
        const auto filter = [&](const ImageF& image) {
            return filterImage(image.width, image.height, filters, [&](size_t x, size_t y) {
                const float* p = image.pixel(uint32_t(x), uint32_t(y));
                return glm::dvec3(aces(scale * double(p[0])), aces(scale * double(p[1])), aces(scale * double(p[2])));
            });
        };
        const Plane error = difference(filter(test), filter(reference));
        for (size_t k = 0; k < error.data.size(); ++k) largest.data[k] = std::max(largest.data[k], error.data[k]);
    }
    return errorMapOf(largest);
}

}  // namespace voxray
