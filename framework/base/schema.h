#pragma once

#include <string>
#include <vector>

#include "base/parameter.h"
#include "base/value.h"

/// Parameters read out of a config, and as text: what manifests, help pages and the JSON Schema say of them.
namespace voxray {

/// What help pages and JSON Schema say of one parameter.
struct ParameterDoc {
    std::string name;
    std::string type;      ///< "boolean", "integer", "number", "string", "choice", "rgb", "vector"
    std::string help;      ///< With what it has an effect with alone, and whether it lowers noise.
    std::string defaults;  ///< Default as YAML text.
    std::string min, max;  ///< Empty where there is no range.
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

/// A parameter that is written where it has no effect.
struct UnusedSetting {
    std::string name;
    TextLocation where;
    std::string why;  ///< "no effect with method: exact; only with method: three_axis"
};

/// What the functions below do, of a struct without its type.
void readParams(const Schema& schema, void* params, const Value& map, const std::string& owner,
                const std::vector<std::string>& alsoAllowed);
Value writeParams(const Schema& schema, const void* params);
std::vector<UnusedSetting> unusedSettings(const Schema& schema, const void* params, const Value& map);
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

/// Reads one parameter that stands alone, as a scene's environment does that is a radiance.
template <typename P, typename T>
void readParam(P& params, T P::*member, const Value& value, const std::string& what) {
    const size_t offset = schema_detail::offsetOf(params, member);
    for (const Parameter& parameter : schemaOf<P>())
        if (parameter.offset == offset) parameter.type->read(parameter.of(&params), value, what);
}

/// The parameters that a map names although others leave them without effect.
template <typename P>
std::vector<UnusedSetting> unusedSettings(const P& params, const Value& map) {
    return unusedSettings(schemaOf<P>(), &params, map);
}

/// Every parameter with its value, defaults filled in: what the manifest records.
template <typename P>
Value writeParams(const P& params) {
    return writeParams(schemaOf<P>(), &params);
}

/// Help of every parameter, in the order of the schema.
template <typename P>
std::vector<ParameterDoc> describeParams() {
    const P defaults;
    return describeParams(schemaOf<P>(), &defaults);
}

}  // namespace voxray
