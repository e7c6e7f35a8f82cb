#include "scene/pbrt/named_spectra.h"

#include <map>

#include "base/lower_case.h"

namespace voxray::pbrt {
namespace {

template <typename Value>
std::optional<Value> find(const std::map<std::string, Value>& table, const std::string& name) {
    const auto entry = table.find(lowerCase(name));
    if (entry == table.end()) return {};
    return entry->second;
}

}  // namespace

std::optional<glm::vec3> namedMetalReflectance(const std::string& name) {
    static const std::map<std::string, glm::vec3> table{
        {"metal-ag", {0.9715f, 0.9599f, 0.9153f}},   {"metal-al", {0.9132f, 0.9215f, 0.9244f}},
        {"metal-au", {1.0000f, 0.7816f, 0.3440f}},   {"metal-cu", {0.9547f, 0.6379f, 0.5381f}},
        {"metal-cuzn", {0.9100f, 0.7777f, 0.4235f}}, {"metal-mgo", {0.0723f, 0.0731f, 0.0739f}},
        {"metal-tio2", {0.1955f, 0.2069f, 0.2212f}},
    };
    return find(table, name.substr(0, name.find_last_of('-')));
}

std::optional<float> namedGlassIndex(const std::string& name) {
    static const std::map<std::string, float> table{
        {"glass-bk7", 1.5168f}, {"glass-baf10", 1.6700f}, {"glass-fk51a", 1.4866f}, {"glass-lasf9", 1.8503f},
        {"glass-f5", 1.6727f},  {"glass-f10", 1.7283f},   {"glass-f11", 1.7847f},
    };
    return find(table, name);
}

std::optional<glm::dvec2> namedIlluminant(const std::string& name) {
    static const std::map<std::string, glm::dvec2> table{
        {"stdillum-a", {0.44758, 0.40745}},   {"stdillum-d50", {0.34567, 0.35850}},
        {"stdillum-d65", {0.31272, 0.32903}}, {"stdillum-f1", {0.31310, 0.33727}},
        {"stdillum-f2", {0.37208, 0.37529}},  {"stdillum-f3", {0.40910, 0.39430}},
        {"stdillum-f4", {0.44018, 0.40329}},  {"stdillum-f5", {0.31379, 0.34531}},
        {"stdillum-f6", {0.37790, 0.38835}},  {"stdillum-f7", {0.31292, 0.32933}},
        {"stdillum-f8", {0.34588, 0.35875}},  {"stdillum-f9", {0.37417, 0.37281}},
        {"stdillum-f10", {0.34609, 0.35986}}, {"stdillum-f11", {0.38052, 0.37713}},
        {"stdillum-f12", {0.43695, 0.40441}}, {"illum-acesd60", {0.32168, 0.33767}},
    };
    return find(table, name);
}

}  // namespace voxray::pbrt
