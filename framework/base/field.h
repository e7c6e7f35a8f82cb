#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

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

template <typename E>
std::string enumName(E value) {
    for (const auto& [candidate, name] : EnumNames<E>::names)
        if (candidate == value) return name;
    return {};
}

/// Values of another parameter: one of `values`, or none of them.
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
    bool isLessNoise = false;

    /// The same parameter: a number of rays, points or samples, of which more are less noise.
    constexpr Field lessNoise() && {
        isLessNoise = true;
        return std::move(*this);
    }

    /// The same parameter, a place or a direction: one number does not stand for all three.
    constexpr Field asVector() && {
        isVector = true;
        return std::move(*this);
    }

    /// The same parameter, which has an effect with certain values of others alone:
    /// field("samples", ...).onlyWith(oneOf(&Params::method, {Method::Sampled})). Written where none of these
    /// conditions holds it is an error (unusedSettings()); the pass takes no notice of it there.
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

}  // namespace voxray
