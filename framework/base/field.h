#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

/// Declarative parameters. A struct lists its fields in `schema()`, from which parsing, ranges, defaults,
/// help and JSON Schema are derived:
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

template <typename E>
std::string enumName(E value) {
    for (const auto& [candidate, name] : EnumNames<E>::names)
        if (candidate == value) return name;
    return {};
}

/// A condition on another parameter: its value is one of `values`, or none of them.
template <typename Owner, typename T>
struct Condition {
    T Owner::*member;
    std::vector<T> values;
    bool isOneOf;
};

template <typename Owner, typename T>
constexpr Condition<Owner, T> oneOf(T Owner::*member, std::type_identity_t<std::vector<T>> values) {
    return {member, std::move(values), true};
}
template <typename Owner, typename T>
constexpr Condition<Owner, T> noneOf(T Owner::*member, std::type_identity_t<std::vector<T>> values) {
    return {member, std::move(values), false};
}

/// A parameter. `min` and `max` are inclusive; `allowed`: its only values, empty: any. It has an effect if
/// one of its conditions holds, or without conditions.
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
    bool isLessNoise = false;

    /// Marks a number of rays, points or samples, of which more mean less noise.
    constexpr Field lessNoise() && {
        isLessNoise = true;
        return std::move(*this);
    }

    /// Marks a position or a direction: a scalar is no value for all three components.
    constexpr Field asVector() && {
        isVector = true;
        return std::move(*this);
    }

    /// Restricts the parameter's effect to certain values of others:
    /// field("samples", ...).onlyWith(oneOf(&Params::method, {Method::Sampled})). If none of these conditions
    /// holds, naming it is an error (unusedSettings()), and the pass ignores it.
    template <typename... Others>
    constexpr Field<Owner, T, Others...> onlyWith(Others... others) && {
        return {name,     member,     help, min, max, ranged, std::move(allowed), {std::move(others)...},
                isVector, isLessNoise};
    }
};

template <typename Owner, typename T>
constexpr Field<Owner, T> field(const char* name, T Owner::*member, const char* help) {
    return {name, member, help, T{}, T{}, false};
}
template <typename Owner, typename T>
constexpr Field<Owner, T> field(const char* name, T Owner::*member, const char* help, std::type_identity_t<T> min,
                                std::type_identity_t<T> max) {
    return {name, member, help, min, max, true};
}
/// A parameter with a list of values: field("block", &Params::block, "...", {1, 2, 4, 8}).
template <typename Owner, typename T>
constexpr Field<Owner, T> field(const char* name, T Owner::*member, const char* help,
                                std::type_identity_t<std::vector<T>> allowed) {
    return {name, member, help, T{}, T{}, false, std::move(allowed)};
}

/// The powers of two from `min` to `max`, both powers of two.
constexpr std::vector<uint32_t> powersOfTwo(uint32_t min, uint32_t max) {
    std::vector<uint32_t> powers{min};
    while (powers.back() < max) powers.push_back(2 * powers.back());
    return powers;
}

}  // namespace voxray
