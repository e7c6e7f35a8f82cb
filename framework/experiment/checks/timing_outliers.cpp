#include "experiment/checks/timing_outliers.h"

#include <algorithm>
#include <map>

namespace voxray {
namespace {

constexpr double kMinMs = 5;
constexpr double kMaxBuildRatio = 1.2;  ///< Slowest to fastest of equal builds.
constexpr double kMaxFrameRatio = 1.5;  ///< 95th to 5th percentile of a variant's frames.
constexpr const char* kAdvice = "run it again on an idle machine";

/// The fastest and the slowest of equal builds.
struct Builds {
    const VariantResult* fastest;
    const VariantResult* slowest;

    double ratio() const { return slowest->buildMs / fastest->buildMs; }
};

double frameRatio(const TimedVariant& variant) {
    return variant.result->frameMs.p95 / variant.result->frameMs.p05;
}

}  // namespace

std::vector<std::string> timingOutliers(const std::vector<TimedVariant>& variants) {
    std::vector<std::string> warnings;
    std::map<std::string, Builds> equal;  // By TimedVariant::build.
    for (const TimedVariant& variant : variants) {
        const VariantResult* result = variant.result;
        if (!result->ok || variant.build.empty() || result->buildMs < kMinMs) continue;
        Builds& builds = equal.try_emplace(variant.build, Builds{result, result}).first->second;
        if (result->buildMs < builds.fastest->buildMs) builds.fastest = result;
        if (result->buildMs > builds.slowest->buildMs) builds.slowest = result;
    }
    const auto worst = std::ranges::max_element(equal, {}, [](const auto& e) { return e.second.ratio(); });
    if (worst != equal.end() && worst->second.ratio() > kMaxBuildRatio) {
        const auto& [fastest, slowest] = worst->second;
        warnings.push_back(
            fmt::format("times were disturbed: the same build took {:.1f} ms in '{}' and {:.1f} ms in '{}': {}",
                        fastest->buildMs, fastest->name, slowest->buildMs, slowest->name, kAdvice));
    }

    std::vector<TimedVariant> uneven;
    std::ranges::copy_if(variants, std::back_inserter(uneven), [](const TimedVariant& variant) {
        return variant.result->ok && variant.isSteady && variant.result->frameMs.p05 >= kMinMs &&
               frameRatio(variant) > kMaxFrameRatio;
    });
    if (uneven.empty()) return warnings;
    const VariantResult& most = *std::ranges::max_element(uneven, {}, frameRatio)->result;
    warnings.push_back(fmt::format(
        "times were disturbed: frames of '{}' took {:.1f} to {:.1f} ms (5th to 95th percentile){}: {}", most.name,
        most.frameMs.p05, most.frameMs.p95,
        uneven.size() > 1 ? fmt::format(", and those of {} more differ as much", uneven.size() - 1) : "", kAdvice));
    return warnings;
}

}  // namespace voxray
