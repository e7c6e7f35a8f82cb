#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>

/// The members of a C++ struct, by name and place, without a word from whoever writes the struct: what a
/// shader declares as its push constants is compared with them, so that the two can't drift apart.
namespace voxray {

/// One member of a struct of push constants.
struct PushMember {
    std::string_view name;
    uint32_t offset = 0;  ///< Bytes from the struct's start.
    uint32_t bytes = 0;
};

namespace push_layout {

/// Takes the place of any member in an initializer: how many fit is how many members there are.
struct AnyMember {
    template <typename T>
    constexpr operator T() const;
};

template <typename T, typename... Members>
constexpr size_t memberCount() {
    if constexpr (requires { T{Members{}..., AnyMember{}}; })
        return memberCount<T, Members..., AnyMember>();
    else
        return sizeof...(Members);
}

/// An object whose members' addresses are known to the compiler, for their names.
template <typename T>
inline constexpr T kInstance{};

/// Addresses of all members.
template <typename T>
constexpr auto memberAddresses(const T& t) {
    const auto addresses = [](const auto&... members) { return std::tuple(&members...); };
    constexpr size_t count = memberCount<T>();
    static_assert(count >= 1 && count <= 16, "push constants have 1 to 16 members");
#define VOXRAY_MEMBERS(number, ...)    \
    if constexpr (count == number) {   \
        const auto& [__VA_ARGS__] = t; \
        return addresses(__VA_ARGS__); \
    }
    VOXRAY_MEMBERS(1, a)
    VOXRAY_MEMBERS(2, a, b)
    VOXRAY_MEMBERS(3, a, b, c)
    VOXRAY_MEMBERS(4, a, b, c, d)
    VOXRAY_MEMBERS(5, a, b, c, d, e)
    VOXRAY_MEMBERS(6, a, b, c, d, e, f)
    VOXRAY_MEMBERS(7, a, b, c, d, e, f, g)
    VOXRAY_MEMBERS(8, a, b, c, d, e, f, g, h)
    VOXRAY_MEMBERS(9, a, b, c, d, e, f, g, h, i)
    VOXRAY_MEMBERS(10, a, b, c, d, e, f, g, h, i, j)
    VOXRAY_MEMBERS(11, a, b, c, d, e, f, g, h, i, j, k)
    VOXRAY_MEMBERS(12, a, b, c, d, e, f, g, h, i, j, k, l)
    VOXRAY_MEMBERS(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
    VOXRAY_MEMBERS(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
    VOXRAY_MEMBERS(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
    VOXRAY_MEMBERS(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
#undef VOXRAY_MEMBERS
}

/// The name of the member at `address`: compilers print it in a function's signature, as in
/// "... P = (& kInstance<Push>.Push::seed); ..." (GCC) or "... P = &kInstance<Push>.seed]" (Clang).
template <const auto* address>
constexpr std::string_view memberName() {
    std::string_view signature = __PRETTY_FUNCTION__;
    signature = signature.substr(signature.find('&'));
    signature = signature.substr(0, signature.find_first_of(";]"));
    if (signature.ends_with(')')) signature.remove_suffix(1);
    return signature.substr(signature.find_last_of(".:") + 1);
}

template <typename T, size_t... index>
std::span<const PushMember> listMembers(std::index_sequence<index...>) {
    constexpr auto addresses = memberAddresses(kInstance<T>);
    static const std::array<PushMember, sizeof...(index)> members{
        PushMember{memberName<std::get<index>(addresses)>(),
                   uint32_t(reinterpret_cast<const char*>(std::get<index>(addresses)) -
                            reinterpret_cast<const char*>(&kInstance<T>)),
                   uint32_t(sizeof(*std::get<index>(addresses)))}...};
    return members;
}

}  // namespace push_layout

/// The members of a struct of push constants in their order; none for a single number, vector or matrix.
template <typename T>
std::span<const PushMember> pushMembers() {
    if constexpr (std::is_aggregate_v<T>)
        return push_layout::listMembers<T>(std::make_index_sequence<push_layout::memberCount<T>()>());
    else
        return {};
}

}  // namespace voxray
