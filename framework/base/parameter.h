#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/value.h"

/// Type-erased fields of a struct, so that one function reads parameters of all structs, with few template
/// instantiations for hundreds of fields.
namespace voxray {

/// Reads, checks and writes values of one type.
class ParameterType {
 public:
    virtual ~ParameterType() = default;
    virtual const char* name() const = 0;  ///< ParameterDoc::type.
    /// @throws UsageError if the value has another type, is out of range or not allowed.
    virtual void read(void* target, const Value& value, const std::string& what) const = 0;
    virtual std::string text(const void* field) const = 0;
    virtual Value value(const void* field) const = 0;
    virtual std::string min() const { return {}; }  ///< "" without a range.
    virtual std::string max() const { return {}; }
    virtual std::vector<std::string> choices() const { return {}; }  ///< The only values; empty: any.
};

/// A text file by its name, which is relative to the file that names it, or to the working folder where that is
/// none; it is read with the parameter.
struct TextFile {
    std::string name;  ///< As it was written; empty: none.
    std::string path;  ///< For messages.
    std::string text;
};

/// A program with its arguments. It is to run in the folder of the file that names it.
struct ProgramCommand {
    std::vector<std::string> words;  ///< Empty: none.
    std::string file;                ///< Where it is written: a file, or what else a config came from.
};

/// A folder by its name, which is relative to the file that names it, or to the working folder where that is none.
struct FolderName {
    std::string name;  ///< As it was written; empty: none.
    std::string path;
};

/// Defined for bool, the integers, float, double, glm::vec3, std::string, and the three above (parameter.cpp,
/// file_parameter.cpp).
template <typename T>
std::shared_ptr<const ParameterType> parameterType(T min, T max, bool isRanged, std::vector<T> allowed, bool isVector);
template <>
std::shared_ptr<const ParameterType> parameterType<TextFile>(TextFile, TextFile, bool, std::vector<TextFile>, bool);
template <>
std::shared_ptr<const ParameterType> parameterType<ProgramCommand>(ProgramCommand, ProgramCommand, bool,
                                                                   std::vector<ProgramCommand>, bool);
template <>
std::shared_ptr<const ParameterType> parameterType<FolderName>(FolderName, FolderName, bool, std::vector<FolderName>,
                                                               bool);

/// An enum of 32 bits by its names.
std::shared_ptr<const ParameterType> choiceType(std::vector<std::pair<uint32_t, std::string>> names);

/// One field of a struct.
struct Parameter {
    /// A condition on another parameter: its value is one of `values`, or none of them.
    struct Condition {
        size_t offset;  ///< The other parameter's.
        std::vector<std::string> values;
        bool isOneOf;
    };

    const char* name;
    const char* help;
    size_t offset;  ///< In the struct, bytes.
    std::shared_ptr<const ParameterType> type;
    std::vector<Condition> conditions;  ///< It has an effect if one of these holds, or if empty.
    bool isLessNoise;

    const void* of(const void* params) const { return static_cast<const char*>(params) + offset; }
    void* of(void* params) const { return static_cast<char*>(params) + offset; }
};

using Schema = std::vector<Parameter>;

namespace schema_detail {

template <typename T>
std::shared_ptr<const ParameterType> typeOf(T min, T max, bool isRanged, std::vector<T> allowed, bool isVector) {
    if constexpr (std::is_enum_v<T>) {
        static_assert(sizeof(T) == sizeof(uint32_t));
        std::vector<std::pair<uint32_t, std::string>> names;
        for (const auto& [value, name] : EnumNames<T>::names) names.emplace_back(uint32_t(value), name);
        return choiceType(std::move(names));
    } else {
        return parameterType<T>(std::move(min), std::move(max), isRanged, std::move(allowed), isVector);
    }
}

/// Defined for the same types as parameterType().
template <typename T>
std::vector<std::string> plainTexts(const std::vector<T>& values);

template <typename T>
std::vector<std::string> textsOf(const std::vector<T>& values) {
    if constexpr (std::is_enum_v<T>) {
        std::vector<std::string> texts;
        for (const T value : values) texts.push_back(enumName(value));
        return texts;
    } else {
        return plainTexts(values);
    }
}

template <typename P, typename Member>
size_t offsetOf(const P& params, Member member) {
    return size_t(reinterpret_cast<const char*>(&(params.*member)) - reinterpret_cast<const char*>(&params));
}

template <typename P, typename F>
void addParameter(Schema& schema, const P& params, F field) {
    std::vector<Parameter::Condition> conditions;
    std::apply(
        [&](const auto&... c) {
            (conditions.push_back({offsetOf(params, c.member), textsOf(c.values), c.isOneOf}), ...);
        },
        field.conditions);
    schema.push_back({field.name, field.help, offsetOf(params, field.member),
                      typeOf(field.min, field.max, field.ranged, std::move(field.allowed), field.isVector),
                      std::move(conditions), field.isLessNoise});
}

}  // namespace schema_detail

/// The parameters of a struct, in the order of its schema().
template <typename P>
const Schema& schemaOf() {
    static const Schema schema = [] {
        Schema parameters;
        const P params;
        std::apply([&](auto... fields) { (schema_detail::addParameter(parameters, params, std::move(fields)), ...); },
                   P::schema());
        return parameters;
    }();
    return schema;
}

}  // namespace voxray
