#include "config/value_labels.h"

#include <algorithm>
#include <map>
#include <set>

namespace voxray {
namespace {

/// Members of a value's entries: index of the entry, and key.
using MemberNames = std::set<std::pair<size_t, std::string>>;

bool hasMaps(const Value& list) {
    return std::ranges::any_of(list.items, [](const Value& item) { return item.isMap(); });
}

/// The entries of a list of maps; any other value is a single entry.
std::vector<const Value*> entriesOf(const Value& value) {
    if (!value.isList() || !hasMaps(value)) return {&value};
    std::vector<const Value*> entries;
    for (const Value& item : value.items) entries.push_back(&item);
    return entries;
}

/// The member that names an entry, or nullptr.
const Value::Member* namingMember(const Value& entry) {
    static const std::set<std::string> naming{"pass", "builtin", "file", "directional", "point", "spot"};
    for (const Value::Member& member : entry.members)
        if (naming.contains(member.key) && member.value.isScalar()) return &member;
    return nullptr;
}

/// Label of an entry, with some of its members.
std::string label(const Value& entry, size_t number, const MemberNames& shownMembers) {
    if (entry.isScalar()) return entry.scalar;
    if (entry.isList() && entry.items.empty()) return "none";
    const Value::Member* naming = namingMember(entry);
    if (!naming) return entry.text();
    std::string text = naming->value.scalar;
    for (const Value::Member& member : entry.members)
        if (&member != naming && shownMembers.contains({number, member.key}))
            text += " " + member.key + " " + member.value.text();
    return text;
}

std::string label(const Value& value, const MemberNames& shownMembers) {
    std::string text;
    const std::vector<const Value*> entries = entriesOf(value);
    for (size_t e = 0; e < entries.size(); ++e) text += (e ? " + " : "") + label(*entries[e], e, shownMembers);
    return text;
}

MemberNames differences(const std::vector<Value>& values, const std::vector<size_t>& group) {
    std::map<MemberNames::value_type, std::vector<std::string>> texts;
    for (const size_t i : group) {
        const std::vector<const Value*> entries = entriesOf(values[i]);
        for (size_t e = 0; e < entries.size(); ++e)
            for (const auto& [key, member] : entries[e]->members) texts[{e, key}].push_back(member.text());
    }
    MemberNames names;
    for (const auto& [name, found] : texts) {
        const bool isInAll = found.size() == group.size();
        if (!isInAll || std::ranges::count(found, found[0]) < ptrdiff_t(found.size())) names.insert(name);
    }
    return names;
}

std::map<std::string, std::vector<size_t>> groupsOf(const std::vector<std::string>& labels) {
    std::map<std::string, std::vector<size_t>> groups;
    for (size_t i = 0; i < labels.size(); ++i) groups[labels[i]].push_back(i);
    return groups;
}

}  // namespace

std::vector<std::string> valueLabels(const std::vector<Value>& values) {
    std::vector<std::string> labels;
    for (const Value& value : values) labels.push_back(label(value, {}));
    for (const auto& [text, group] : groupsOf(labels)) {
        if (group.size() == 1) continue;
        const MemberNames shownMembers = differences(values, group);
        for (const size_t i : group) labels[i] = label(values[i], shownMembers);
    }
    for (const auto& [text, group] : groupsOf(labels))
        if (group.size() > 1)
            for (const size_t i : group) labels[i] = values[i].text();
    return labels;
}

}  // namespace voxray
