#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "passes/path_trace/bsdf.h"

namespace voxray::path_trace {
namespace {

const glm::vec3 kNormal = glm::normalize(glm::vec3(0.3f, -0.5f, 0.7f));

glm::vec3 directionAt(double cosine, double phi) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return Frame(kNormal).toWorld({float(sine * std::cos(phi)), float(sine * std::sin(phi)), float(cosine)});
}

Bsdf metal(float roughness) {
    return Bsdf::make(glm::vec3(1), 1, roughness, 1, glm::vec3(1), 1.5f);
}
Bsdf plastic(float roughness) {
    return Bsdf::make({0.8f, 0.5f, 0.2f}, 0, roughness, 1, glm::vec3(1), 1.5f);
}

/// Integral over the upper hemisphere of f(direction), midpoint rule in cosine² and angle.
template <typename F>
double integrate(const F& f, int cosines = 800, int angles = 400) {
    constexpr double kTwoPi = 6.283185307179586;
    double sum = 0;
    for (int i = 0; i < cosines; ++i) {
        const double s = (i + 0.5) / cosines, cosine = s * s;
        for (int j = 0; j < angles; ++j)
            sum += f(directionAt(cosine, (j + 0.5) / angles * kTwoPi)) * 2 * s / cosines * kTwoPi / angles;
    }
    return sum;
}

TEST(Reflection, DirectionsAlongTheSurfaceHaveNoWeight) {
    // On the rim of the disk that is mapped to the hemisphere the cosine is rounded to 0, and so is the density: a path
    // that went on would weigh what it hits by 0 / 0
    const Bsdf lambert = Bsdf::make({0.8f, 0.5f, 0.2f}, 0, 1, 0, glm::vec3(1), 1.5f);
    constexpr int kPoints = 4096;
    int along = 0;
    for (int i = 0; i < kPoints; ++i) {
        const BsdfSample sample = lambert.sample(kNormal, kNormal, {0.0f, float(i) / kPoints}, 0);
        if (sample.pdf > 0) continue;
        ++along;
        EXPECT_EQ(sample.weight, glm::vec3(0));
    }
    EXPECT_GT(along, 0);
}

TEST(Reflection, SpecularZeroIsExactlyLambert) {
    const Bsdf b = Bsdf::make({0.8f, 0.5f, 0.2f}, 0, 0.3f, 0, glm::vec3(1), 1.5f);
    for (const double cosine : {0.1, 0.5, 1.0}) {
        const BsdfValue v = b.evaluate(directionAt(0.02, 1), directionAt(cosine, 2), kNormal);
        EXPECT_NEAR(v.fCos.x, 0.8 / 3.14159265358979 * cosine, 1e-6);
        EXPECT_NEAR(v.pdf, cosine / 3.14159265358979, 1e-6);
    }
}

TEST(Reflection, NormalIncidenceReflectanceFollowsIor) {
    const Bsdf b = Bsdf::make({0.8f, 0.5f, 0.2f}, 0, 0.3f, 0.5f, {1, 0.5f, 1}, 1.33f);
    const float f0 = 0.5f * (0.33f / 2.33f) * (0.33f / 2.33f);
    EXPECT_NEAR(b.fresnel(1).x, f0, 1e-6);
    EXPECT_NEAR(b.fresnel(1).y, 0.5f * f0, 1e-6);
    EXPECT_NEAR(b.fresnel(0).x, 0.5f, 1e-6);
    EXPECT_NEAR(metal(0.3f).fresnel(1).x, 1, 1e-6);
}

TEST(Reflection, WhiteMetalNeverGainsEnergy) {
    for (const float roughness : {0.2f, 0.5f, 1.0f})
        for (const double cosine : {0.05, 0.3, 0.7, 1.0}) {
            const glm::vec3 out = directionAt(cosine, 0.3);
            const double albedo =
                integrate([&](const glm::vec3& in) { return metal(roughness).evaluate(out, in, kNormal).fCos.x; });
            EXPECT_LE(albedo, 1.002) << roughness << " " << cosine;
            EXPECT_GE(albedo, 0.25) << roughness << " " << cosine;
            // Seen from above, the roughest surface has a constant distribution: a closed form.
            if (roughness == 1.0f && cosine == 1.0) {
                EXPECT_NEAR(albedo, 1 - std::log(2.0), 1e-4);
            }
        }
}

TEST(Reflection, IsReciprocal) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.05, 1);
    for (int i = 0; i < 1000; ++i) {
        const Bsdf b = i % 2 ? plastic(float(unit(random))) : metal(float(unit(random)));
        const double cosA = unit(random), cosB = unit(random);
        const glm::vec3 a = directionAt(cosA, 7 * unit(random)), c = directionAt(cosB, 7 * unit(random));
        const double there = b.evaluate(a, c, kNormal).fCos.y / cosB;
        const double back = b.evaluate(c, a, kNormal).fCos.y / cosA;
        EXPECT_NEAR(there, back, 2e-4 * (there + back) + 1e-6);
    }
}

/// Draws with a stratified grid; calls visit(sample).
template <typename Visit>
void drawMany(const Bsdf& b, const glm::vec3& out, uint32_t count, const Visit& visit) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 0x1.fffffep-1f);
    for (uint32_t i = 0; i < count; ++i) visit(b.sample(out, kNormal, {unit(random), unit(random)}, unit(random)));
}

TEST(Reflection, SamplesFollowTheirDensity) {
    constexpr int kCosines = 8, kAngles = 8;
    constexpr uint32_t kDraws = 100000;
    for (const Bsdf& b : {metal(0.3f), metal(0.8f), plastic(0.4f)})
        for (const double cosine : {0.2, 0.9}) {
            const glm::vec3 out = directionAt(cosine, 0.3);
            const Frame frame(kNormal);
            const auto binOf = [&](const glm::vec3& in) {
                const glm::vec3 local = frame.toLocal(in);
                const double phi = std::atan2(local.y, local.x) / 6.283185307179586 + 0.5;
                return std::min(int(local.z * kCosines), kCosines - 1) * kAngles +
                       std::min(int(phi * kAngles), kAngles - 1);
            };
            std::vector<double> drawn(kCosines * kAngles), expected(kCosines * kAngles);
            double lost = kDraws, mean = 0;
            drawMany(b, out, kDraws, [&](const BsdfSample& s) {
                if (!(s.pdf > 0)) return;
                drawn[size_t(binOf(s.direction))] += 1;
                lost -= 1;
                mean += s.weight.y / kDraws;
                EXPECT_NEAR(s.pdf, b.evaluate(out, s.direction, kNormal).pdf, 2e-2 * s.pdf);
            });
            const double total = integrate([&](const glm::vec3& in) {
                const double pdf = b.evaluate(out, in, kNormal).pdf;
                return pdf;
            });
            integrate([&](const glm::vec3& in) {
                const double s = std::sqrt(std::max(double(glm::dot(in, kNormal)), 0.0));
                expected[size_t(binOf(in))] += b.evaluate(out, in, kNormal).pdf * 2 * s / 800 * 6.283185307179586 / 400;
                return 0.0;
            });

            // What isn't lost below the surface is where the density says, and weights average to the albedo.
            EXPECT_LE(total, 1.002);
            EXPECT_NEAR(total, 1 - lost / kDraws, 0.01);
            double chi2 = 0;
            int degrees = 0;
            for (size_t i = 0; i < drawn.size(); ++i) {
                const double e = expected[i] * kDraws;
                if (e < 5) continue;
                chi2 += (drawn[i] - e) * (drawn[i] - e) / (e + 1e-4 * e * e);
                ++degrees;
            }
            EXPECT_LT(chi2, degrees + 5 * std::sqrt(2.0 * degrees));
            const double albedo = integrate([&](const glm::vec3& in) { return b.evaluate(out, in, kNormal).fCos.y; });
            EXPECT_NEAR(mean, albedo, 0.01);
        }
}

TEST(Reflection, MirrorsAreExactAndGrazingViewsFinite) {
    const Bsdf mirror = metal(0);
    const BsdfSample s = mirror.sample(directionAt(0.6, 1), kNormal, {0.5f, 0.5f}, 0.5f);
    EXPECT_TRUE(s.isMirror);
    EXPECT_NEAR(glm::dot(s.direction, directionAt(0.6, 1 + 3.14159265358979)), 1, 1e-6);
    EXPECT_NEAR(s.weight.x, 1, 1e-5);
    for (const Bsdf& b : {metal(0.04f), metal(0.3f), plastic(0.0f), plastic(1.0f)})
        for (const double cosine : {-0.2, 0.0, 1e-6, 1e-3})
            drawMany(b, directionAt(cosine, 0.3), 1000, [&](const BsdfSample& r) {
                ASSERT_TRUE(std::isfinite(r.weight.x + r.pdf + r.direction.x));
                ASSERT_GE(r.weight.x, 0);
            });
}

TEST(Warps, TrianglesDisksAndMisWeights) {
    double u = 0, uv = 0, r2 = 0;
    constexpr int kSide = 100;
    for (int i = 0; i < kSide * kSide; ++i) {
        const float x = (float(i % kSide) + 0.5f) / kSide, y = (float(i / kSide) + 0.5f) / kSide;
        const glm::vec2 t = uniformTriangle(x, y), d = uniformDisk(x, y);
        EXPECT_LE(t.x + t.y, 1.000001f);
        u += t.x;
        uv += t.x * t.y;
        r2 += glm::dot(d, d);
    }
    EXPECT_NEAR(u / kSide / kSide, 1.0 / 3, 1e-3);
    EXPECT_NEAR(uv / kSide / kSide, 1.0 / 12, 1e-3);
    EXPECT_NEAR(r2 / kSide / kSide, 0.5, 1e-3);
    EXPECT_FLOAT_EQ(misWeight(2, 1) + misWeight(1, 2), 1);
}

TEST(AliasTable, DrawsInProportion) {
    const std::vector<double> weights{1, 0, 5, 2};
    const AliasTable table(weights);
    std::vector<double> drawn(4);
    for (int i = 0; i < 8000; ++i) drawn[table.draw((float(i) + 0.5f) / 8000)] += 1;
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(drawn[i], weights[i] * 1000, 4);
        EXPECT_FLOAT_EQ(table.probability(uint32_t(i)), float(weights[i] / 8));
    }
    EXPECT_TRUE(AliasTable(std::vector<double>{0, 0}).empty());
}

}  // namespace
}  // namespace voxray::path_trace
