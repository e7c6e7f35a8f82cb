#include "experiment/idle_parameters.h"

#include <map>
#include <set>

#include "config/overrides.h"
#include "experiment/validate.h"

namespace voxray {

std::vector<IdlePath> idlePaths(const Variant& variant, const Registry& registry) {
    std::vector<IdlePath> paths;
    for (const Value& entry : variant.setup.graph.items) {
        const std::string id = passId(entry);
        const PassKind& kind = registry.require(entry.find("pass")->scalar, entry.where);
        for (IdleParameter& parameter : kind.idle(entry, id, Graph::reservedKeys()))
            paths.push_back({id + "." + parameter.name, std::move(parameter)});
    }
    return paths;
}

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

    std::set<std::vector<std::string>> working;
    std::map<std::vector<std::string>, IdlePath> idle;
    for (const WiredVariant& variant : wired.variants) {
        std::set<std::string> idleHere;
        for (const IdlePath& entry : variant.idle) {
            idleHere.insert(entry.path);
            idle.emplace(placeOf(variant, entry.path, entry.parameter.where), entry);
        }
        for (const Value& pass : variant.setup.graph.items)
            for (const auto& [key, value] : pass.members)
                if (const std::string path = passId(pass) + "." + key; idleHere.count(path) == 0)
                    working.insert(placeOf(variant, path, value.where));
    }
    for (const auto& [place, entry] : idle)
        if (working.count(place) == 0)
            throw UsageError(entry.parameter.where, "{}: {}; leave it out", entry.path, entry.parameter.why);
}

}  // namespace voxray
