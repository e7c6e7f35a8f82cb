#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace voxray::test {

/// A pass's parameter for the small scenes of tests, unless the test gives it.
struct TestDefault {
    std::string_view pass, parameter, value;
};
inline constexpr TestDefault kTestDefaults[] = {
    {"voxelize", "resolution", "32"},
    {"inject_light_rays", "rays_per_light", "65536"},
    {"inject_voxel_rays", "paths_per_point", "1"},
    {"link_surfels", "rays_per_surfel", "16"},
};

/// A graph as YAML. Each entry is a pass and its parameters, such as "voxelize, resolution: 24"; empty
/// entries are skipped.
inline std::string graphYaml(const std::vector<std::string>& entries) {
    std::string yaml;
    for (const std::string& entry : entries) {
        if (entry.empty()) continue;
        yaml += (yaml.empty() ? "[{pass: " : ", {pass: ") + entry;
        for (const auto& [pass, parameter, value] : kTestDefaults) {
            const bool isPass = entry.substr(0, entry.find(',')) == pass;
            const bool isGiven = entry.find(", " + std::string(parameter) + ":") != std::string::npos;
            if (isPass && !isGiven) yaml.append(", ").append(parameter).append(": ").append(value);
        }
        yaml += "}";
    }
    return yaml + "]";
}

}  // namespace voxray::test
