#include "base/schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/suggest.h"

namespace voxray {
namespace {

const Parameter& parameterAt(const Schema& schema, size_t offset) {
    return *std::ranges::find(schema, offset, &Parameter::offset);
}

/// "method: three_axis | dominant_axis or bound other than 0"; "" for a parameter that always has an effect.
std::string conditionsText(const Schema& schema, const Parameter& parameter) {
    std::vector<std::string> texts;
    for (const Parameter::Condition& condition : parameter.conditions)
        texts.push_back(fmt::format("{}{}{}", parameterAt(schema, condition.offset).name,
                                    condition.isOneOf ? ": " : " other than ", fmt::join(condition.values, " | ")));
    return fmt::format("{}", fmt::join(texts, " or "));
}

/// ", as in {width: 640, height: 360}": the first parameters that have a default.
std::string exampleOf(const Schema& schema, const void* defaults) {
    std::vector<std::string> entries;
    for (const Parameter& parameter : schema) {
        const std::string value = parameter.type->text(parameter.of(defaults));
        if (!value.empty() && entries.size() < 2) entries.push_back(fmt::format("{}: {}", parameter.name, value));
    }
    return entries.empty() ? "" : fmt::format(", as in {{{}}}", fmt::join(entries, ", "));
}

[[noreturn]] void refuseKey(const std::string& key, const TextLocation& where, const std::string& owner,
                            const std::vector<std::string>& valid) {
    if (key.find_first_not_of("0123456789") == std::string::npos)
        throw UsageError(where, "{}: '{}' is no parameter: write numbers without commas", owner, key);
    if (key.find(':') != std::string::npos)
        throw UsageError(where, "{}: unknown parameter '{}'; a space is missing after ':'", owner, key);
    if (key.find('=') != std::string::npos)
        throw UsageError(where, "{}: unknown parameter '{}'; write ':' in place of '='", owner, key);
    throw UsageError(where, "{}: unknown parameter '{}'{}", owner, key, didYouMean(key, valid));
}

}  // namespace

void readParams(const Schema& schema, void* params, const Value& map, const std::string& owner,
                const std::vector<std::string>& alsoAllowed) {
    if (map.isNull()) return;
    if (!map.isMap())
        throw UsageError(map.where, "{}: expected a map of parameters{}", owner, exampleOf(schema, params));
    std::vector<std::string> valid;
    for (const Parameter& parameter : schema) valid.emplace_back(parameter.name);
    valid.insert(valid.end(), alsoAllowed.begin(), alsoAllowed.end());
    for (const auto& [key, value] : map.members) {
        if (std::ranges::find(valid, key) == valid.end()) refuseKey(key, value.where, owner, valid);
        for (const Parameter& parameter : schema)
            if (key == parameter.name)
                parameter.type->read(parameter.of(params), value, owner.empty() ? key : owner + "." + key);
    }
}

Value writeParams(const Schema& schema, const void* params) {
    Value map = Value::map();
    for (const Parameter& parameter : schema) map.set(parameter.name, parameter.type->value(parameter.of(params)));
    return map;
}

std::vector<UnusedSetting> unusedSettings(const Schema& schema, const void* params, const Value& map) {
    std::vector<UnusedSetting> unused;
    for (const Parameter& parameter : schema) {
        const Value* written = map.find(parameter.name);
        if (!written || parameter.conditions.empty()) continue;
        bool hasEffect = false;
        std::vector<std::string> current;
        for (const Parameter::Condition& condition : parameter.conditions) {
            const Parameter& required = parameterAt(schema, condition.offset);
            const std::string text = required.type->text(required.of(params));
            hasEffect = hasEffect || (std::ranges::count(condition.values, text) > 0) == condition.isOneOf;
            current.push_back(fmt::format("{}: {}", required.name, text));
        }
        if (!hasEffect)
            unused.push_back({parameter.name, written->where,
                              fmt::format("no effect with {}; only with {}", fmt::join(current, ", "),
                                          conditionsText(schema, parameter))});
    }
    return unused;
}

std::vector<ParameterDoc> describeParams(const Schema& schema, const void* defaults) {
    std::vector<ParameterDoc> docs;
    for (const Parameter& parameter : schema) {
        ParameterDoc doc{parameter.name,
                         parameter.type->name(),
                         parameter.help,
                         parameter.type->text(parameter.of(defaults)),
                         parameter.type->min(),
                         parameter.type->max(),
                         parameter.type->choices(),
                         parameter.isLessNoise,
                         {}};
        for (const Parameter::Condition& condition : parameter.conditions)
            doc.conditions.push_back({parameterAt(schema, condition.offset).name, condition.values, condition.isOneOf});
        if (parameter.isLessNoise) doc.help += " Larger: less noise.";
        if (const std::string needs = conditionsText(schema, parameter); !needs.empty())
            doc.help += " Only with " + needs + ".";
        docs.push_back(std::move(doc));
    }
    return docs;
}

}  // namespace voxray
