#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/field_text.h"
#include "base/hex_color.h"
#include "base/suggest.h"
#include "base/value.h"

/// Reads parameters out of a config.
namespace voxray {

/// A parameter that is written where it has no effect.
struct IdleParameter {
    std::string name;
    TextLocation where;
    std::string why;  ///< "no effect with method: exact; only with method: three_axis"
};

namespace schema_detail {

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
        if (value.isScalar() && !value.isNumber()) {
            const std::string linear = linearTriple(value.scalar);
            throw UsageError(
                value.where, "{}: expected a number, not '{}', or three{}", what, value.scalar,
                linear.empty() ? ", as in [1, 1, 1]" : fmt::format(": write {}, its linear values", linear));
        } else if (value.isScalar()) {
            out = glm::vec3(float(value.asNumber(what)));
        } else {
            if (!value.isList() || value.items.size() != 3)
                throw UsageError(value.where, "{}: expected three numbers, as in [1, 1, 1]{}", what,
                                 value.isNull() ? "; nothing is written here: '#' begins a comment" : "");
            for (int i = 0; i < 3; ++i) out[i] = float(value.items[size_t(i)].asNumber(what));
        }
    } else {
        static_assert(std::is_same_v<T, std::string>, "no reader for this parameter type");
        out = value.asString(what);
    }
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
        if (!known && key.find(':') != std::string::npos)
            throw UsageError(value.where, "{}: unknown parameter '{}'; a space is missing after ':'", owner,
                             key);
        if (!known && key.find('=') != std::string::npos)
            throw UsageError(value.where, "{}: unknown parameter '{}'; write ':' in place of '='", owner,
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

}  // namespace voxray
