#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <glm/vec3.hpp>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "base/field.h"
#include "base/value.h"

/// Parameters as text: what manifests, help pages and the JSON Schema say of them.
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
};

namespace schema_detail {

template <typename E>
std::vector<std::string> choicesOf() {
    std::vector<std::string> names;
    for (const auto& [value, name] : EnumNames<E>::names) names.emplace_back(name);
    return names;
}

template <typename T>
std::string textOf(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
        return value ? "true" : "false";
    } else if constexpr (std::is_enum_v<T>) {
        for (const auto& [candidate, name] : EnumNames<T>::names)
            if (candidate == value) return name;
        return {};
    } else if constexpr (std::is_arithmetic_v<T>) {
        return fmt::format("{}", value);
    } else if constexpr (std::is_same_v<T, glm::vec3>) {
        return fmt::format("[{}, {}, {}]", value.x, value.y, value.z);
    } else {
        return value;
    }
}

template <typename T>
std::vector<std::string> textsOf(const std::vector<T>& values) {
    std::vector<std::string> texts;
    for (const T& value : values) texts.push_back(textOf(value));
    return texts;
}

template <typename T>
constexpr const char* typeName() {
    if constexpr (std::is_same_v<T, bool>)
        return "boolean";
    else if constexpr (std::is_enum_v<T>)
        return "choice";
    else if constexpr (std::is_integral_v<T>)
        return "integer";
    else if constexpr (std::is_floating_point_v<T>)
        return "number";
    else if constexpr (std::is_same_v<T, glm::vec3>)
        return "rgb";
    else
        return "string";
}

}  // namespace schema_detail

/// "three_axis | dominant_axis" with the parameter's name, or "bound other than 0".
template <typename P, typename Owner, typename T>
std::string conditionText(const Condition<Owner, T>& condition) {
    const std::string values = fmt::format("{}", fmt::join(schema_detail::textsOf(condition.values), " | "));
    return fmt::format("{}{}{}", fieldName<P>(condition.member), condition.isOneOf ? ": " : " other than ",
                       values);
}

/// What a parameter needs to have an effect, "" where it always has one.
template <typename P, typename F>
std::string conditionsText(const F& field) {
    std::vector<std::string> texts;
    std::apply([&](const auto&... c) { (texts.push_back(conditionText<P>(c)), ...); }, field.conditions);
    return fmt::format("{}", fmt::join(texts, " or "));
}

/// ", as in {width: 640, height: 360}": the first parameters that have a default.
template <typename P>
std::string exampleOf() {
    const P defaults;
    std::vector<std::string> entries;
    forEachField<P>([&](const auto& f) {
        const std::string value = schema_detail::textOf(defaults.*(f.member));
        if (!value.empty() && entries.size() < 2) entries.push_back(fmt::format("{}: {}", f.name, value));
    });
    return entries.empty() ? "" : fmt::format(", as in {{{}}}", fmt::join(entries, ", "));
}

/// Every parameter with its value, defaults filled in: what the manifest records.
template <typename P>
Value writeParams(const P& params) {
    Value map = Value::map();
    forEachField<P>([&](const auto& f) {
        using T = std::remove_cvref_t<decltype(params.*(f.member))>;
        if constexpr (std::is_same_v<T, glm::vec3>) {
            Value list = Value::list();
            for (int i = 0; i < 3; ++i)
                list.items.push_back(Value::fromScalar(fmt::format("{}", (params.*(f.member))[i])));
            map.set(f.name, list);
        } else {
            map.set(f.name, Value::fromScalar(schema_detail::textOf(params.*(f.member)),
                                              std::is_same_v<T, std::string>));
        }
    });
    return map;
}

/// Help of every parameter, in the order of the schema.
template <typename P>
std::vector<ParameterDoc> describeParams() {
    std::vector<ParameterDoc> docs;
    const P defaults;
    forEachField<P>([&](const auto& f) {
        using T = std::remove_cvref_t<decltype(defaults.*(f.member))>;
        ParameterDoc doc;
        doc.name = f.name;
        doc.type = f.isVector ? "vector" : schema_detail::typeName<T>();
        doc.help = f.help;
        doc.isLessNoise = f.isLessNoise;
        if (f.isLessNoise) doc.help += " Larger: less noise.";
        if (const std::string needs = conditionsText<P>(f); !needs.empty())
            doc.help += " Only with " + needs + ".";
        doc.defaults = schema_detail::textOf(defaults.*(f.member));
        if (f.ranged) {
            doc.min = schema_detail::textOf(f.min);
            doc.max = schema_detail::textOf(f.max);
        }
        if constexpr (std::is_enum_v<T>)
            doc.choices = schema_detail::choicesOf<T>();
        else
            doc.choices = schema_detail::textsOf(f.allowed);
        docs.push_back(doc);
    });
    return docs;
}

}  // namespace voxray
