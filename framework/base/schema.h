#pragma once

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/suggest.h"
#include "base/value.h"

/// Parameters written once. A struct lists its fields in `schema()`; parsing, ranges, defaults, help and
/// JSON Schema all come from that list:
///
///     struct Params {
///         uint32_t raysPerLight = 1024;
///         static constexpr auto schema() {
///             return std::tuple{
///                 field("rays_per_light", &Params::raysPerLight, "Rays of each light.", 1u, 1u << 26)};
///         }
///     };
namespace voxray {

/// Specialise for an enum that a parameter uses:
///     template <> struct EnumNames<Write> {
///         static constexpr std::array names{std::pair{Write::Average, "average"}, ...}; };
template <typename E>
struct EnumNames;

/// Values of another parameter: one of `values`, or none of them.
template <typename Owner, typename T>
struct Condition {
    T Owner::*member;
    std::vector<T> values;
    bool isOneOf;

    constexpr bool holds(const T& value) const {
        return (std::ranges::find(values, value) != values.end()) == isOneOf;
    }
};

template <typename Owner, typename T>
constexpr Condition<Owner, T> oneOf(T Owner::*member, std::type_identity_t<std::vector<T>> values) {
    return {member, std::move(values), true};
}
template <typename Owner, typename T>
constexpr Condition<Owner, T> noneOf(T Owner::*member, std::type_identity_t<std::vector<T>> values) {
    return {member, std::move(values), false};
}

/// One parameter. `min` and `max` are inclusive; `allowed` are the only values it may have, empty: any. It
/// has an effect where one of its conditions holds; without conditions, always.
template <typename Owner, typename T, typename... Conditions>
struct Field {
    const char* name;
    T Owner::*member;
    const char* help;
    T min;
    T max;
    bool ranged;
    std::vector<T> allowed = {};
    std::tuple<Conditions...> conditions = {};
    bool isVector = false;

    /// The same parameter, a place or a direction: one number does not stand for all three.
    constexpr Field asVector() && {
        isVector = true;
        return std::move(*this);
    }

    /// The same parameter, which has an effect with certain values of others alone:
    /// field("samples", ...).onlyWith(oneOf(&Params::method, {Method::Sampled})). Written where none of these
    /// conditions holds it is an error (idleParams()); the pass takes no notice of it there.
    template <typename... Others>
    constexpr Field<Owner, T, Others...> onlyWith(Others... others) && {
        return {name, member, help, min, max, ranged, std::move(allowed), {std::move(others)...}, isVector};
    }
};

template <typename Owner, typename T>
constexpr Field<Owner, T> field(const char* name, T Owner::*member, const char* help) {
    return {name, member, help, T{}, T{}, false};
}
template <typename Owner, typename T>
constexpr Field<Owner, T> field(const char* name, T Owner::*member, const char* help,
                                std::type_identity_t<T> min, std::type_identity_t<T> max) {
    return {name, member, help, min, max, true};
}
/// A parameter that has to be one of some values: field("block", &Params::block, "...", {1, 2, 4, 8}).
template <typename Owner, typename T>
constexpr Field<Owner, T> field(const char* name, T Owner::*member, const char* help,
                                std::type_identity_t<std::vector<T>> allowed) {
    return {name, member, help, T{}, T{}, false, std::move(allowed)};
}

/// The powers of two from `min` to `max`, which are two of them.
constexpr std::vector<uint32_t> powersOfTwo(uint32_t min, uint32_t max) {
    std::vector<uint32_t> powers{min};
    while (powers.back() < max) powers.push_back(2 * powers.back());
    return powers;
}

/// A parameter that is written where it has no effect.
struct IdleParameter {
    std::string name;
    TextLocation where;
    std::string why;  ///< "no effect with method: exact; only with method: three_axis"
};

/// What help pages and JSON Schema say of one parameter.
struct ParameterDoc {
    std::string name;
    std::string type;      ///< "boolean", "integer", "number", "string", "choice", "rgb", "vector"
    std::string help;      ///< With what it has an effect with alone.
    std::string defaults;  ///< Default as YAML text.
    std::string min, max;  ///< Empty where there is no range.
    std::vector<std::string> choices;  ///< The only values; empty: any of the type and range.
};

namespace schema_detail {

template <typename E>
std::vector<std::string> choicesOf() {
    std::vector<std::string> names;
    for (const auto& [value, name] : EnumNames<E>::names) names.emplace_back(name);
    return names;
}

/// Reads an integer of any type, which may be narrower than its range.
template <typename T>
T integerIn(int64_t number, T min, T max, const Value& at, const std::string& what) {
    if (std::cmp_less(number, min) || std::cmp_greater(number, max))
        throw UsageError(at.where, "{}: {} is out of range [{}, {}]", what, number, min, max);
    return T(number);
}

template <typename T>
void readInto(T& out, const Value& value, const std::string& what) {
    if constexpr (std::is_same_v<T, bool>) {
        out = value.asBool(what);
    } else if constexpr (std::is_enum_v<T>) {
        const std::string text = value.asString(what);
        for (const auto& [candidate, name] : EnumNames<T>::names) {
            if (text == name) {
                out = candidate;
                return;
            }
        }
        throw UsageError(value.where, "{}: unknown value '{}'{}", what, text,
                         didYouMean(text, choicesOf<T>()));
    } else if constexpr (std::is_integral_v<T>) {
        using Limits = std::numeric_limits<T>;
        out = integerIn<T>(value.asInteger(what), Limits::min(), Limits::max(), value, what);
    } else if constexpr (std::is_floating_point_v<T>) {
        out = T(value.asNumber(what));
    } else if constexpr (std::is_same_v<T, glm::vec3>) {
        if (value.isScalar()) {
            out = glm::vec3(float(value.asNumber(what)));
        } else {
            if (!value.isList() || value.items.size() != 3)
                throw UsageError(value.where, "{}: expected three numbers, as in [1, 1, 1]", what);
            for (int i = 0; i < 3; ++i) out[i] = float(value.items[size_t(i)].asNumber(what));
        }
    } else {
        static_assert(std::is_same_v<T, std::string>, "no reader for this parameter type");
        out = value.asString(what);
    }
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

template <typename T>
void checkRange(const T& value, const T& min, const T& max, const Value& at, const std::string& what) {
    if constexpr (std::is_arithmetic_v<T>) {
        if (value < min || value > max)
            throw UsageError(at.where, "{}: {} is out of range [{}, {}]", what, value, min, max);
    } else if constexpr (std::is_same_v<T, glm::vec3>) {
        for (int i = 0; i < 3; ++i) checkRange(value[i], min[i], max[i], at, what);
    }
}

template <typename T>
std::vector<std::string> textsOf(const std::vector<T>& values) {
    std::vector<std::string> texts;
    for (const T& value : values) texts.push_back(textOf(value));
    return texts;
}

template <typename T>
void checkAllowed(const T& value, const std::vector<T>& allowed, const Value& at, const std::string& what) {
    if (!allowed.empty() && std::ranges::find(allowed, value) == allowed.end())
        throw UsageError(at.where, "{}: {} is not allowed; one of: {}", what, textOf(value),
                         fmt::join(textsOf(allowed), ", "));
}

/// Reads one parameter and checks that it may have that value.
template <typename P, typename F>
void readField(P& params, const F& field, const Value& value, const std::string& what) {
    auto& out = params.*(field.member);
    using T = std::remove_cvref_t<decltype(out)>;
    if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
        if (field.ranged) {
            out = integerIn<T>(value.asInteger(what), field.min, field.max, value, what);
            return;
        }
    if (field.isVector && value.isScalar())
        throw UsageError(value.where, "{}: expected three numbers, as in [0, 1, 0], not '{}'", what,
                         value.scalar);
    readInto(out, value, what);
    if (field.ranged) checkRange(out, field.min, field.max, value, what);
    checkAllowed(out, field.allowed, value, what);
}

}  // namespace schema_detail

template <typename P, typename Visitor>
void forEachField(Visitor&& visit) {
    std::apply([&](const auto&... fields) { (visit(fields), ...); }, P::schema());
}

/// The name of the parameter that a member holds.
template <typename P, typename Member>
std::string fieldName(Member member) {
    std::string name;
    forEachField<P>([&](const auto& f) {
        if constexpr (std::is_same_v<decltype(f.member), Member>)
            if (f.member == member) name = f.name;
    });
    return name;
}

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

/// The parameters that a map names although others leave them without effect.
template <typename P>
std::vector<IdleParameter> idleParams(const P& params, const Value& map) {
    std::vector<IdleParameter> idle;
    forEachField<P>([&](const auto& f) {
        const Value* written = map.find(f.name);
        if (!written || conditionsText<P>(f).empty()) return;
        bool holds = false;
        std::vector<std::string> present;
        const auto look = [&](const auto& condition) {
            const auto& value = params.*(condition.member);
            holds = holds || condition.holds(value);
            present.push_back(fieldName<P>(condition.member) + ": " + schema_detail::textOf(value));
        };
        std::apply([&](const auto&... c) { (look(c), ...); }, f.conditions);
        if (!holds)
            idle.push_back({f.name, written->where,
                            fmt::format("no effect with {}; only with {}", fmt::join(present, ", "),
                                        conditionsText<P>(f))});
    });
    return idle;
}

template <typename P>
std::vector<std::string> fieldNames() {
    std::vector<std::string> names;
    forEachField<P>([&](const auto& f) { names.emplace_back(f.name); });
    return names;
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

/// Reads a map into a parameter struct. Every key must be a field or one of `alsoAllowed`.
/// @param owner name put before each key in errors, e.g. "voxelize"; empty: the config itself.
/// @throws UsageError naming file, line, key and the nearest valid word.
template <typename P>
P readParams(const Value& map, const std::string& owner, const std::vector<std::string>& alsoAllowed = {}) {
    P params;
    if (map.isNull()) return params;
    if (!map.isMap())
        throw UsageError(map.where, "{}: expected a map of parameters{}", owner, exampleOf<P>());
    std::vector<std::string> valid = fieldNames<P>();
    valid.insert(valid.end(), alsoAllowed.begin(), alsoAllowed.end());
    for (size_t i = 0; i < map.members.size(); ++i) {
        const auto& [key, value] = map.members[i];
        bool known = false;
        for (const std::string& name : valid) known = known || name == key;
        if (!known && key.find_first_not_of("0123456789") == std::string::npos)
            throw UsageError(value.where, "{}: '{}' is no parameter: write numbers without commas", owner,
                             key);
        if (!known)
            throw UsageError(value.where, "{}: unknown parameter '{}'{}", owner, key, didYouMean(key, valid));
        forEachField<P>([&, &key = key, &value = value](const auto& f) {
            if (key != f.name) return;
            schema_detail::readField(params, f, value, owner.empty() ? key : owner + "." + key);
        });
    }
    return params;
}

/// Reads one parameter that stands alone, as a scene's environment does that is a radiance.
template <typename P, typename T>
void readParam(P& params, T P::*member, const Value& value, const std::string& what) {
    forEachField<P>([&](const auto& f) {
        if constexpr (std::is_same_v<decltype(f.member), T P::*>)
            if (f.member == member) schema_detail::readField(params, f, value, what);
    });
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
