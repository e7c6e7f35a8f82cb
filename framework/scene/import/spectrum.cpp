#include "scene/import/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "base/error.h"
#include "base/srgb.h"
#include "scene/import/numbers.h"

namespace voxray {
namespace {

/// CIE 1931 standard observer (x̄, ȳ, z̄) and D65 at 380, 390 … 780 nm. Source: CIE 15:2004.
struct ObserverRow {
    double x, y, z, d65;
};
constexpr std::array<ObserverRow, 41> kObserver{{
    {0.0014, 0.0000, 0.0065, 49.98},  {0.0042, 0.0001, 0.0201, 54.65},  {0.0143, 0.0004, 0.0679, 82.75},
    {0.0435, 0.0012, 0.2074, 91.49},  {0.1344, 0.0040, 0.6456, 93.43},  {0.2839, 0.0116, 1.3856, 86.68},
    {0.3483, 0.0230, 1.7471, 104.86}, {0.3362, 0.0380, 1.7721, 117.01}, {0.2908, 0.0600, 1.6692, 117.81},
    {0.1954, 0.0910, 1.2876, 114.86}, {0.0956, 0.1390, 0.8130, 115.92}, {0.0320, 0.2080, 0.4652, 108.81},
    {0.0049, 0.3230, 0.2720, 109.35}, {0.0093, 0.5030, 0.1582, 107.80}, {0.0633, 0.7100, 0.0782, 104.79},
    {0.1655, 0.8620, 0.0422, 107.69}, {0.2904, 0.9540, 0.0203, 104.41}, {0.4334, 0.9950, 0.0087, 104.05},
    {0.5945, 0.9950, 0.0039, 100.00}, {0.7621, 0.9520, 0.0021, 96.33},  {0.9163, 0.8700, 0.0017, 95.79},
    {1.0263, 0.7570, 0.0011, 88.69},  {1.0622, 0.6310, 0.0008, 90.01},  {1.0026, 0.5030, 0.0003, 89.60},
    {0.8544, 0.3810, 0.0002, 87.70},  {0.6424, 0.2650, 0.0000, 83.29},  {0.4479, 0.1750, 0.0000, 83.70},
    {0.2835, 0.1070, 0.0000, 80.03},  {0.1649, 0.0610, 0.0000, 80.21},  {0.0874, 0.0320, 0.0000, 82.28},
    {0.0468, 0.0170, 0.0000, 78.28},  {0.0227, 0.0082, 0.0000, 69.72},  {0.0114, 0.0041, 0.0000, 71.61},
    {0.0058, 0.0021, 0.0000, 74.35},  {0.0029, 0.0010, 0.0000, 61.60},  {0.0014, 0.0005, 0.0000, 69.89},
    {0.0007, 0.0002, 0.0000, 75.09},  {0.0003, 0.0001, 0.0000, 63.59},  {0.0002, 0.0001, 0.0000, 46.42},
    {0.0001, 0.0000, 0.0000, 66.81},  {0.0000, 0.0000, 0.0000, 63.38},
}};

double valueAt(const SpectrumPoints& spectrum, double nm) {
    if (spectrum.empty() || nm < spectrum.front().first || nm > spectrum.back().first) return 0;
    const auto next = std::ranges::upper_bound(spectrum, nm, {}, &SpectrumPoints::value_type::first);
    if (next == spectrum.end()) return spectrum.back().second;
    const auto& [x1, y1] = *next;
    const auto& [x0, y0] = *(next - 1);
    return y0 + (y1 - y0) * (nm - x0) / (x1 - x0);
}

/// ∫ v (x̄, ȳ, z̄) w dλ in steps of 1 nm between the table's rows. @param weight 1 or D65, by row
template <typename Value, typename Weight>
glm::dvec3 observed(const Value& value, const Weight& weight) {
    glm::dvec3 sum(0);
    for (size_t i = 0; i + 1 < kObserver.size(); ++i)
        for (int step = 0; step < 10; ++step) {
            const double t = (step + 0.5) / 10;
            const ObserverRow &a = kObserver[i], &b = kObserver[i + 1];
            const glm::dvec3 bar = (1 - t) * glm::dvec3(a.x, a.y, a.z) + t * glm::dvec3(b.x, b.y, b.z);
            sum += bar * value(380 + 10 * double(i) + step + 0.5) * ((1 - t) * weight(a) + t * weight(b));
        }
    return sum;
}
constexpr auto kOne = [](const auto&) { return 1.0; };
constexpr auto kDaylight = [](const ObserverRow& row) { return row.d65; };

/// Linear Rec.709 to XYZ by its primaries and the white of D65 (ITU-R BT.709), or likewise of other primaries.
glm::dmat3 xyzFromPrimaries(const glm::dvec2& r, const glm::dvec2& g, const glm::dvec2& b, const glm::dvec2& white) {
    const auto xyz = [](const glm::dvec2& c) { return glm::dvec3(c.x / c.y, 1, (1 - c.x - c.y) / c.y); };
    const glm::dmat3 columns(xyz(r), xyz(g), xyz(b));
    const glm::dvec3 scale = glm::inverse(columns) * xyz(white);
    return {columns[0] * scale.x, columns[1] * scale.y, columns[2] * scale.z};
}
const glm::dvec2 kWhiteD65(0.3127, 0.3290);
glm::dmat3 xyzFromRec709() {
    return xyzFromPrimaries({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kWhiteD65);
}

}  // namespace

SpectrumPoints readSpectrumPoints(const std::string& text) {
    std::string plain;
    bool comment = false;
    for (const char c : text) {
        comment = c == '#' || (comment && c != '\n');
        plain += comment || c == ':' || c == ',' ? ' ' : c;
    }
    const std::vector<double> numbers = readNumbers(plain);
    if (numbers.empty() || numbers.size() % 2 != 0) throw Error("a spectrum is pairs of wavelength and value");
    SpectrumPoints points;
    for (size_t i = 0; i < numbers.size(); i += 2) {
        if (!points.empty() && !(numbers[i] > points.back().first))
            throw Error("the wavelengths of a spectrum increase; {} follows {}", numbers[i], points.back().first);
        points.emplace_back(numbers[i], numbers[i + 1]);
    }
    return points;
}

glm::dvec3 xyzOfEmission(const SpectrumPoints& spectrum) {
    return observed([&](double nm) { return valueAt(spectrum, nm); }, kOne) / observed(kOne, kOne).y;
}

glm::vec3 rgbOfXyz(const glm::dvec3& xyz) {
    return glm::vec3(glm::max(glm::inverse(xyzFromRec709()) * xyz, glm::dvec3(0)));
}

glm::vec3 rgbOfReflectance(const SpectrumPoints& spectrum) {
    const glm::dvec3 seen = observed([&](double nm) { return valueAt(spectrum, nm); }, kDaylight);
    // By the table's own white, so that 1 is exactly (1, 1, 1)
    const glm::dvec3 white = observed(kOne, kDaylight);
    return rgbOfXyz(seen / white * (xyzFromRec709() * glm::dvec3(1)));
}

glm::vec3 rgbOfQuantity(const SpectrumPoints& spectrum) {
    const auto clamped = [&](double nm) {
        return valueAt(spectrum, std::clamp(nm, spectrum.front().first, spectrum.back().first));
    };
    const glm::dvec3 seen = observed(clamped, kDaylight);
    const glm::dvec3 white = observed(kOne, kDaylight);
    return rgbOfXyz(seen / white * (xyzFromRec709() * glm::dvec3(1)));
}

glm::dvec3 xyzOfBlackbody(double kelvin) {
    // c1 = 2 h c² in W m² / sr and c2 = h c / k in m K (CODATA 2018); per nm, not per m
    constexpr double c1 = 1.191042972e-16, c2 = 1.438776877e-2;
    const auto radiance = [&](double nm) {
        const double meters = nm * 1e-9;
        return 1e-9 * c1 / (std::pow(meters, 5) * std::expm1(c2 / (meters * kelvin)));
    };
    return observed(radiance, kOne) / observed(kOne, kOne).y;
}

std::optional<glm::vec3> rgbOfHex(const std::string& text) {
    if (text.size() != 7 || text[0] != '#') return {};
    glm::vec3 rgb(0);
    for (int i = 0; i < 3; ++i) {
        const std::string digits = text.substr(size_t(1 + 2 * i), 2);
        if (digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) return {};
        rgb[i] = srgbDecode(float(std::stoi(digits, nullptr, 16)) / 255.0f);
    }
    return rgb;
}

std::optional<glm::dmat3> rec709Of(const std::string& colorSpace) {
    const glm::dmat3 toRec709 = glm::inverse(xyzFromRec709());
    if (colorSpace == "srgb") return glm::dmat3(1);
    if (colorSpace == "dci-p3")
        return toRec709 * xyzFromPrimaries({0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kWhiteD65);
    if (colorSpace == "rec2020")
        return toRec709 * xyzFromPrimaries({0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kWhiteD65);
    if (colorSpace == "aces2065-1")
        return toRec709 * xyzFromPrimaries({0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}, {0.32168, 0.33767});
    return {};
}

}  // namespace voxray
