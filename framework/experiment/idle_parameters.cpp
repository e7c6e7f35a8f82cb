#include "experiment/idle_parameters.h"

#include <algorithm>
#include <map>
#include <set>

#include "config/overrides.h"
#include "experiment/validate.h"

namespace voxray {

void checkIdleParameters(const WiredExperiment& wired) {
    // Sweeps over whole passes bring parameters of their own: each choice of them is looked at alone
    const std::vector<std::string> keys = sweepKeys(wired.experiment);
    const auto placeOf = [&](const WiredVariant& variant, const std::string& path,
                             const TextLocation& where) {
        std::vector<std::string> place{path, where.str()};
        for (size_t a = 0; a < keys.size(); ++a)
            if (keys[a].find('.') == std::string::npos) place.push_back(variant.values[a]);
        return place;
    };

    std::map<std::vector<std::string>, IdleParameter> idle;
    std::set<std::string> paths;
    for (const WiredVariant& variant : wired.variants)
        for (const IdleParameter& parameter : variant.idle) {
            paths.insert(parameter.name);
            idle.emplace(placeOf(variant, parameter.name, parameter.where), parameter);
        }
    if (idle.empty()) return;
    std::set<std::vector<std::string>> working;
    for (const WiredVariant& variant : wired.variants)
        for (const Value& pass : variant.setup.graph.items)
            for (const auto& [key, value] : pass.members) {
                const std::string path = passId(pass) + "." + key;
                if (paths.contains(path) && std::ranges::count(variant.idle, path, &IdleParameter::name) == 0)
                    working.insert(placeOf(variant, path, value.where));
            }
    for (const auto& [place, parameter] : idle)
        if (working.count(place) == 0)
            throw UsageError(parameter.where, "{}: {}; leave it out", parameter.name, parameter.why);
}

}  // namespace voxray
