#include "base/parameter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <glm/vec3.hpp>
#include <limits>

#include "base/hex_color.h"
#include "base/suggest.h"

namespace voxray {
namespace {

template <typename T>
constexpr bool kIsInteger = std::is_integral_v<T> && !std::is_same_v<T, bool>;

template <typename T>
std::string textOf(const T& value) {
    if constexpr (std::is_same_v<T, bool>)
        return value ? "true" : "false";
    else if constexpr (std::is_same_v<T, glm::vec3>)
        return fmt::format("[{}, {}, {}]", value.x, value.y, value.z);
    else
        return fmt::format("{}", value);
}

glm::vec3 readTriple(const Value& value, const std::string& what) {
    if (value.isScalar() && !value.isNumber()) {
        const std::string linear = linearTriple(value.scalar);
        throw UsageError(value.where, "{}: expected a number, not '{}', or three{}", what, value.scalar,
                         linear.empty() ? ", as in [1, 1, 1]" : fmt::format(": write {}, its linear values", linear));
    }
    if (value.isScalar()) return glm::vec3(float(value.asNumber(what)));
    if (!value.isList() || value.items.size() != 3)
        throw UsageError(value.where, "{}: expected three numbers, as in [1, 1, 1]{}", what,
                         value.isNull() ? "; nothing is written here: '#' begins a comment" : "");
    glm::vec3 triple;
    for (int i = 0; i < 3; ++i) triple[i] = float(value.items[size_t(i)].asNumber(what));
    return triple;
}

template <typename T>
void checkRange(const T& value, const T& min, const T& max, const Value& source, const std::string& what) {
    if constexpr (std::is_same_v<T, glm::vec3>) {
        for (int i = 0; i < 3; ++i) checkRange(value[i], min[i], max[i], source, what);
    } else if constexpr (std::is_arithmetic_v<T>) {
        if (value < min || value > max)
            throw UsageError(source.where, "{}: {} is out of range [{}, {}]", what, value, min, max);
    }
}

template <typename T>
class PlainType final : public ParameterType {
 public:
    PlainType(T min, T max, bool isRanged, std::vector<T> allowed, bool isVector)
        : min_(std::move(min)),
          max_(std::move(max)),
          isRanged_(isRanged),
          allowed_(std::move(allowed)),
          isVector_(isVector) {}

    const char* name() const override {
        if constexpr (std::is_same_v<T, bool>) return "boolean";
        if constexpr (std::is_integral_v<T>) return "integer";
        if constexpr (std::is_floating_point_v<T>) return "number";
        if constexpr (std::is_same_v<T, glm::vec3>) return isVector_ ? "vector" : "rgb";
        return "string";
    }

    void read(void* target, const Value& value, const std::string& what) const override {
        if (isVector_ && value.isScalar())
            throw UsageError(value.where, "{}: expected three numbers, as in [0, 1, 0], not '{}'", what, value.scalar);
        const T read = parse(value, what);
        if (isRanged_) checkRange(read, min_, max_, value, what);
        if (!allowed_.empty() && std::ranges::find(allowed_, read) == allowed_.end())
            throw UsageError(value.where, "{}: {} is not allowed; one of: {}", what, textOf(read),
                             fmt::join(choices(), ", "));
        *static_cast<T*>(target) = read;
    }

    std::string text(const void* field) const override { return textOf(*static_cast<const T*>(field)); }

    Value value(const void* field) const override {
        if constexpr (std::is_same_v<T, glm::vec3>) {
            Value list = Value::list();
            const glm::vec3& triple = *static_cast<const glm::vec3*>(field);
            for (int i = 0; i < 3; ++i) list.items.push_back(Value::fromScalar(textOf(triple[i])));
            return list;
        } else {
            return Value::fromScalar(text(field), std::is_same_v<T, std::string>);
        }
    }

    std::string min() const override { return isRanged_ ? textOf(min_) : std::string(); }
    std::string max() const override { return isRanged_ ? textOf(max_) : std::string(); }
    std::vector<std::string> choices() const override { return schema_detail::plainTexts(allowed_); }

 private:
    T parse(const Value& value, const std::string& what) const {
        if constexpr (std::is_same_v<T, bool>) {
            return value.asBool(what);
        } else if constexpr (kIsInteger<T>) {
            // The type may be narrower than what is written
            const T low = isRanged_ ? min_ : std::numeric_limits<T>::min(),
                    high = isRanged_ ? max_ : std::numeric_limits<T>::max();
            const int64_t number = value.asInteger(what);
            if (std::cmp_less(number, low) || std::cmp_greater(number, high))
                throw UsageError(value.where, "{}: {} is out of range [{}, {}]", what, number, low, high);
            return T(number);
        } else if constexpr (std::is_floating_point_v<T>) {
            return T(value.asNumber(what));
        } else if constexpr (std::is_same_v<T, glm::vec3>) {
            return readTriple(value, what);
        } else {
            return value.asString(what);
        }
    }

    T min_, max_;
    bool isRanged_;
    std::vector<T> allowed_;
    bool isVector_;
};

class ChoiceType final : public ParameterType {
 public:
    explicit ChoiceType(std::vector<std::pair<uint32_t, std::string>> names) : names_(std::move(names)) {}

    const char* name() const override { return "choice"; }

    void read(void* target, const Value& value, const std::string& what) const override {
        const std::string text = value.asString(what);
        for (const auto& [number, name] : names_)
            if (text == name) {
                std::memcpy(target, &number, sizeof(number));
                return;
            }
        throw UsageError(value.where, "{}: unknown value '{}'{}", what, text, didYouMean(text, choices()));
    }

    std::string text(const void* field) const override {
        uint32_t value = 0;
        std::memcpy(&value, field, sizeof(value));
        for (const auto& [number, name] : names_)
            if (number == value) return name;
        return {};
    }

    Value value(const void* field) const override { return Value::fromScalar(text(field)); }

    std::vector<std::string> choices() const override {
        std::vector<std::string> names;
        for (const auto& [number, name] : names_) names.push_back(name);
        return names;
    }

 private:
    std::vector<std::pair<uint32_t, std::string>> names_;
};

}  // namespace

template <typename T>
std::shared_ptr<const ParameterType> parameterType(T min, T max, bool isRanged, std::vector<T> allowed, bool isVector) {
    return std::make_shared<PlainType<T>>(std::move(min), std::move(max), isRanged, std::move(allowed), isVector);
}

std::shared_ptr<const ParameterType> choiceType(std::vector<std::pair<uint32_t, std::string>> names) {
    return std::make_shared<ChoiceType>(std::move(names));
}

template <typename T>
std::vector<std::string> schema_detail::plainTexts(const std::vector<T>& values) {
    std::vector<std::string> texts;
    for (const T& value : values) texts.push_back(textOf<T>(value));
    return texts;
}

#define VOXRAY_PARAMETER_TYPE(T)                                                                      \
    template std::shared_ptr<const ParameterType> parameterType<T>(T, T, bool, std::vector<T>, bool); \
    template std::vector<std::string> schema_detail::plainTexts<T>(const std::vector<T>&);
VOXRAY_PARAMETER_TYPE(bool)
VOXRAY_PARAMETER_TYPE(int32_t)
VOXRAY_PARAMETER_TYPE(uint32_t)
VOXRAY_PARAMETER_TYPE(uint64_t)
VOXRAY_PARAMETER_TYPE(float)
VOXRAY_PARAMETER_TYPE(double)
VOXRAY_PARAMETER_TYPE(glm::vec3)
VOXRAY_PARAMETER_TYPE(std::string)
#undef VOXRAY_PARAMETER_TYPE

}  // namespace voxray
