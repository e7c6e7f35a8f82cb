#include "scene/import/optics.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/lower_case.h"

namespace voxray {
namespace {

/// Reflectance of a dielectric of relative index eta for light from outside.
double fresnelFromOutside(double cosine, double eta) {
    const double sine2 = (1 - cosine * cosine) / (eta * eta);
    if (sine2 >= 1) return 1;
    const double inside = std::sqrt(1 - sine2);
    const double parallel = (eta * cosine - inside) / (eta * cosine + inside);
    const double across = (cosine - eta * inside) / (cosine + eta * inside);
    return 0.5 * (parallel * parallel + across * across);
}

/// Source: the measured spectra that Mitsuba has, as means over red, green and blue in Tungsten's table.
const std::map<std::string, MetalIndex>& metals() {
    static const std::map<std::string, MetalIndex> table{
        {"a-c", {{2.9441f, 2.2272f, 1.9682f}, {0.8874f, 0.7993f, 0.8153f}}},
        {"ag", {{0.1553f, 0.1167f, 0.1384f}, {4.8283f, 3.1222f, 2.1470f}}},
        {"al", {{1.6574f, 0.8803f, 0.5212f}, {9.2239f, 6.2695f, 4.8370f}}},
        {"au", {{0.1431f, 0.3749f, 1.4424f}, {3.9831f, 2.3857f, 1.6032f}}},
        {"be", {{4.1851f, 3.1851f, 2.7841f}, {3.8354f, 3.0101f, 2.8690f}}},
        {"cr", {{4.3696f, 2.9167f, 1.6547f}, {5.2064f, 4.2313f, 3.7549f}}},
        {"cu", {{0.2004f, 0.9240f, 1.1022f}, {3.9129f, 2.4528f, 2.1421f}}},
        {"cu2o", {{3.5493f, 2.9521f, 2.7369f}, {0.1132f, 0.1947f, 0.6002f}}},
        {"cuo", {{3.2454f, 2.4496f, 2.1974f}, {0.5203f, 0.5707f, 0.7172f}}},
        {"cuzn", {{0.4440f, 0.5270f, 1.0940f}, {3.6950f, 2.7650f, 1.8290f}}},
        {"d-c", {{2.7113f, 2.3186f, 2.2289f}, {0.0f, 0.0f, 0.0f}}},
        {"hg", {{2.3989f, 1.4400f, 0.9095f}, {6.3276f, 4.3719f, 3.4217f}}},
        {"hgte", {{4.7795f, 3.2310f, 2.6600f}, {1.6320f, 1.5808f, 1.7296f}}},
        {"ir", {{3.0864f, 2.0821f, 1.6178f}, {5.5921f, 4.0671f, 3.2672f}}},
        {"k", {{0.0640f, 0.0464f, 0.0381f}, {2.1042f, 1.3489f, 0.9132f}}},
        {"li", {{0.2657f, 0.1956f, 0.2209f}, {3.5402f, 2.3111f, 1.6686f}}},
        {"mgo", {{2.0896f, 1.6507f, 1.5949f}, {0.0f, 0.0f, 0.0f}}},
        {"mo", {{4.4837f, 3.5255f, 2.7761f}, {4.1111f, 3.4209f, 3.1506f}}},
        {"na", {{0.0602f, 0.0561f, 0.0619f}, {3.1793f, 2.1124f, 1.5790f}}},
        {"nb", {{3.4201f, 2.7902f, 2.3956f}, {3.4414f, 2.7376f, 2.5799f}}},
        {"ni", {{2.3673f, 1.6634f, 1.4671f}, {4.4988f, 3.0502f, 2.3454f}}},
        {"rh", {{2.5858f, 1.8602f, 1.5544f}, {6.7822f, 4.7029f, 3.9760f}}},
        {"sic", {{3.1723f, 2.5260f, 2.4794f}, {0.0f, 0.0f, 0.0f}}},
        {"ta", {{2.0626f, 2.3931f, 2.6281f}, {2.4080f, 1.7414f, 1.9470f}}},
        {"te", {{7.5090f, 4.2965f, 2.3699f}, {5.5842f, 4.9476f, 3.9975f}}},
        {"tic", {{3.7005f, 2.8374f, 2.5823f}, {3.2657f, 2.3516f, 2.1728f}}},
        {"tin", {{1.6484f, 1.1504f, 1.3797f}, {3.3684f, 1.9434f, 1.1020f}}},
        {"v", {{4.2775f, 3.5131f, 2.7611f}, {3.4911f, 2.8893f, 3.1116f}}},
        {"vc", {{3.6576f, 2.7527f, 2.5327f}, {3.0684f, 2.1987f, 1.9632f}}},
        {"vn", {{2.8656f, 2.1192f, 1.9401f}, {3.0323f, 2.0561f, 1.6163f}}},
        {"w", {{4.3707f, 3.3002f, 2.9982f}, {3.5006f, 2.6048f, 2.2731f}}},
    };
    return table;
}

}  // namespace

glm::vec3 conductorReflectance(const glm::vec3& eta, const glm::vec3& k, float outside) {
    glm::vec3 reflectance(0);
    for (int c = 0; c < 3; ++c) {
        const double n = double(eta[c]) / outside, e = double(k[c]) / outside;
        reflectance[c] = float(((n - 1) * (n - 1) + e * e) / ((n + 1) * (n + 1) + e * e));
    }
    return reflectance;
}

float dielectricReflectance(float eta) {
    const float root = (eta - 1) / (eta + 1);
    return root * root;
}

float internalDiffuseReflectance(float eta) {
    // Midpoint rule over cos²: ∫ F 2 cos dcos
    constexpr int steps = 1000;
    double mean = 0;
    for (int i = 0; i < steps; ++i) mean += fresnelFromOutside(std::sqrt((i + 0.5) / steps), double(eta)) / steps;
    return float(std::clamp(1 - (1 - mean) / (double(eta) * double(eta)), 0.0, 1.0));
}

float coatedReflectance(float base, float internalReflectance) {
    return base * (1 - internalReflectance) / std::max(1 - base * internalReflectance, 1e-6f);
}

std::optional<float> indexOfRefraction(const std::string& name) {
    // Source: the table of Mitsuba's manual
    static const std::map<std::string, float> table{
        {"vacuum", 1.0f},      {"helium", 1.00004f},         {"hydrogen", 1.00013f},
        {"air", 1.00028f},     {"carbon dioxide", 1.00045f}, {"water", 1.3330f},
        {"acetone", 1.36f},    {"ethanol", 1.361f},          {"carbon tetrachloride", 1.461f},
        {"glycerol", 1.4729f}, {"benzene", 1.501f},          {"silicone oil", 1.52045f},
        {"bromine", 1.661f},   {"water ice", 1.31f},         {"fused quartz", 1.458f},
        {"pyrex", 1.470f},     {"acrylic glass", 1.49f},     {"polypropylene", 1.49f},
        {"bk7", 1.5046f},      {"sodium chloride", 1.544f},  {"amber", 1.55f},
        {"pet", 1.5750f},      {"diamond", 2.419f},
    };
    const auto entry = table.find(lowerCase(name));
    if (entry == table.end()) return {};
    return entry->second;
}

std::optional<MetalIndex> metalIndex(const std::string& name) {
    std::string symbol = lowerCase(name);
    if (symbol.starts_with("metal-")) symbol.erase(0, 6);
    if (!metals().contains(symbol)) symbol = symbol.substr(0, symbol.find_first_of("-_."));
    const auto entry = metals().find(symbol);
    if (entry == metals().end()) return {};
    return entry->second;
}

}  // namespace voxray
