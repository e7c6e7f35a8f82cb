#include "config/yaml.h"

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <unordered_set>
#include <vector>

#include "base/files.h"
#include "config/yaml_faults.h"

namespace voxray {
namespace {

constexpr size_t kMaxBytes = 1u << 20;
constexpr size_t kMaxNodes = 100000;
constexpr int kMaxDepth = 64;

/// Converts yaml-cpp's nodes to Values.
class Converter {
 public:
    Converter(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}

    Value convert(const YAML::Node& node, int depth, const TextLocation& fallback) {
        // Limits: aliases can expand a small file without bound, and a node may contain itself
        const TextLocation where = node.Mark().is_null() ? fallback : locate(node.Mark());
        if (depth > kMaxDepth) throw UsageError(where, "nested more than {} levels deep", kMaxDepth);
        if (++nodes_ > kMaxNodes) throw UsageError(where, "more than {} values", kMaxNodes);
        if (const std::string& tag = node.Tag(); !tag.empty() && tag != "?" && tag != "!")
            throw UsageError(where, "tags such as '{}' are not supported", tag);

        Value value;
        value.where = where;
        switch (node.Type()) {
            case YAML::NodeType::Undefined:
            case YAML::NodeType::Null:
                break;
            case YAML::NodeType::Scalar:
                value.kind = Value::Kind::Scalar;
                value.scalar = node.Scalar();
                value.quoted = node.Tag() == "!";
                if (value.quoted && hasSeveralLines(node.Mark()))
                    throw UsageError(where, "a text in quotes goes on in the next line: is a quote left open?");
                break;
            case YAML::NodeType::Sequence:
                value.kind = Value::Kind::List;
                for (const YAML::Node& item : node) value.items.push_back(convert(item, depth + 1, where));
                break;
            case YAML::NodeType::Map:
                convertMap(node, depth, value);
                break;
        }
        return value;
    }

    TextLocation locate(const YAML::Mark& mark) const { return {file_, mark.is_null() ? 0 : mark.line + 1}; }

 private:
    /// Whether the quoted text at `mark` does not end in its first line.
    bool hasSeveralLines(const YAML::Mark& mark) const {
        if (mark.is_null() || size_t(mark.pos) >= text_.size()) return false;
        const char quote = text_[size_t(mark.pos)];
        if (quote != '"' && quote != '\'') return false;
        for (size_t i = size_t(mark.pos) + 1; i < text_.size() && text_[i] != '\n'; ++i) {
            if (quote == '"' && text_[i] == '\\')
                ++i;
            else if (text_[i] == quote && quote == '\'' && i + 1 < text_.size() && text_[i + 1] == quote)
                ++i;
            else if (text_[i] == quote)
                return false;
        }
        return true;
    }

    void convertMap(const YAML::Node& node, int depth, Value& value) {
        value.kind = Value::Kind::Map;
        std::unordered_set<std::string> keys;
        std::vector<Value> merged;
        for (const auto& entry : node) {
            const TextLocation where = entry.first.Mark().is_null() ? value.where : locate(entry.first.Mark());
            if (!entry.first.IsScalar()) throw UsageError(where, "a key must be a word");
            const std::string& key = entry.first.Scalar();
            if (!keys.insert(key).second) throw UsageError(where, "'{}' appears twice in the same map", key);
            Value member = convert(entry.second, depth + 1, where);
            member.where = where;
            if (key == "<<" && entry.first.Tag() != "!")
                merged = mapsOf(member);
            else
                value.members.push_back({key, std::move(member)});
        }

        // Entries of the map take precedence, then those of earlier merged maps
        for (const Value& map : merged)
            for (const Value::Member& member : map.members)
                if (keys.insert(member.key).second) value.members.push_back(member);
    }

    /// The value of a merge key: a map, or a list of maps.
    static std::vector<Value> mapsOf(const Value& value) {
        std::vector<Value> maps = value.isList() ? value.items : std::vector{value};
        for (const Value& map : maps)
            if (!map.isMap())
                throw UsageError(value.where,
                                 "'<<' puts the entries of a map into this one: expected a map, as in <<: "
                                 "*defaults, or a list of maps");
        return maps;
    }

    const std::string& text_;
    std::string file_;
    size_t nodes_ = 0;
};

void checkUtf8(const std::string& text, const std::string& file) {
    try {
        static_cast<void>(nlohmann::json(text).dump());
    } catch (const nlohmann::json::exception&) {
        throw UsageError({file, 0}, "is not UTF-8 text");
    }
}

}  // namespace

Value parseYaml(const std::string& text, const std::string& fileName) {
    if (text.size() > kMaxBytes) throw UsageError({fileName, 0}, "is larger than 1 MiB; not a config");
    checkUtf8(text, fileName);
    Converter converter(text, fileName);
    try {
        const std::vector<YAML::Node> documents = YAML::LoadAll(text);
        if (documents.size() > 1)
            throw UsageError(converter.locate(documents[1].Mark()), "a second document; one file holds one config");
        if (documents.empty()) return converter.convert(YAML::Node(), 0, {fileName, 1});
        return converter.convert(documents[0], 0, {fileName, 1});
    } catch (const YAML::Exception& error) {
        const YamlFault fault = yamlFault(text, error.mark.is_null() ? 0 : error.mark.line + 1, error.msg);
        throw UsageError({fileName, fault.line}, "bad YAML: {}", fault.message);
    }
}

void locate(Value& value, const TextLocation& where) {
    value.where = where;
    for (Value& item : value.items) locate(item, where);
    for (auto& member : value.members) locate(member.value, where);
}

Value readYaml(const std::filesystem::path& path) {
    std::string text;
    try {
        text = readTextFile(path);
    } catch (const Error& error) {
        throw UsageError("{}", error.what());
    }
    return parseYaml(text, path.string());
}

}  // namespace voxray
