#pragma once

#include <string>
#include <vector>

#include "base/parameter.h"
#include "base/value.h"

/// Reads parameters from a config, and writes them for manifests, help pages and the JSON Schema.
namespace voxray {

/// Documentation of a parameter, for help pages and JSON Schema.
struct ParameterDoc {
    std::string name;
    std::string type;                  ///< "boolean", "integer", "number", "string", "choice", "rgb", "vector", "words"
    std::string help;                  ///< Includes its conditions, and whether it lowers noise.
    std::string defaults;              ///< Default as YAML text.
    std::string min, max;              ///< Empty without a range.
    std::vector<std::string> choices;  ///< The only values; empty: any of the type and range.
    bool isLessNoise = false;          ///< Larger values lower the pass's noise.
    /// Values of another parameter: one of them, or none of them.
    struct Condition {
        std::string parameter;
        std::vector<std::string> values;
        bool isOneOf;
    };
    std::vector<Condition> conditions;  ///< One of these holds where it has an effect; empty: everywhere.
};

/// A parameter in a config that has no effect there.
struct UnusedSetting {
    std::string name;
    TextLocation where;
    std::string why;  ///< "no effect with method: exact; only with method: three_axis"
};

/// Parameters in a map that have no effect because of others.
std::vector<UnusedSetting> unusedSettings(const Schema& schema, const void* params, const Value& map);

/// Type-erased versions of the functions below.
void readParams(const Schema& schema, void* params, const Value& map, const std::string& owner,
                const std::vector<std::string>& alsoAllowed);
Value writeParams(const Schema& schema, const void* params);
std::vector<ParameterDoc> describeParams(const Schema& schema, const void* defaults);

template <typename P>
std::vector<std::string> fieldNames() {
    std::vector<std::string> names;
    for (const Parameter& parameter : schemaOf<P>()) names.emplace_back(parameter.name);
    return names;
}

/// Reads a map into a parameter struct. Every key must be a field or one of `alsoAllowed`.
/// @param owner name put before each key in errors, e.g. "voxelize"; empty: the config itself.
/// @throws UsageError naming file, line, key and the nearest valid word.
template <typename P>
P readParams(const Value& map, const std::string& owner, const std::vector<std::string>& alsoAllowed = {}) {
    P params;
    readParams(schemaOf<P>(), &params, map, owner, alsoAllowed);
    return params;
}

/// Reads a single parameter, such as a scene's environment that is only a radiance.
template <typename P, typename T>
void readParam(P& params, T P::*member, const Value& value, const std::string& what) {
    const size_t offset = schema_detail::offsetOf(params, member);
    for (const Parameter& parameter : schemaOf<P>())
        if (parameter.offset == offset) parameter.type->read(parameter.of(&params), value, what);
}

/// All parameters with their values, including defaults, for the manifest.
template <typename P>
Value writeParams(const P& params) {
    return writeParams(schemaOf<P>(), &params);
}

/// Documentation of all parameters, in the order of the schema.
template <typename P>
std::vector<ParameterDoc> describeParams() {
    const P defaults;
    return describeParams(schemaOf<P>(), &defaults);
}

}  // namespace voxray
