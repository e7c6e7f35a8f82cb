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
    static const std::set<std::string> naming{"builtin", "file", "directional", "point", "spot"};
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

/// A parameter of a pass; inputs are parameters, too.
struct ChainParameter {
    std::string name, value;
    std::string text() const { return name + " " + value; }
};

struct ChainPass {
    std::string name;
    std::vector<ChainParameter> parameters;
};

struct Chain {
    std::string main;                   ///< The last pass that is no filter, or else the last one.
    std::vector<std::string> filtered;  ///< What the passes after it do.
    std::vector<ChainPass> passes;      ///< The main pass, then the others from the last one to the first.
    std::vector<std::string> hidden;    ///< What differs from chains with this main pass, in this order.
    std::vector<std::string> shown;     ///< Of these, what the label has.

    std::string label() const {
        std::string text = main;
        for (const std::string& detail : shown) text += ", " + detail;
        for (const std::string& word : filtered) text += ", " + word;
        return text;
    }
    void show(std::vector<std::string>::iterator detail) {
        shown.push_back(*detail);
        hidden.erase(detail);
    }
};

ChainPass chainPass(const Value& entry) {
    if (entry.isScalar()) return {entry.scalar, {}};
    ChainPass pass;
    for (const auto& [key, value] : entry.members) {
        if (key == "pass")
            pass.name = value.scalar;
        else if (key == "inputs" && value.isMap())
            for (const auto& [port, source] : value.members) pass.parameters.push_back({port, source.text()});
        else if (key != "id")
            pass.parameters.push_back({key, value.text()});
    }
    return pass;
}

Chain chainOf(const Value& value, const FilterLabels& filters) {
    Chain chain;
    for (const Value& entry : value.isList() ? value.items : std::vector{value})
        chain.passes.insert(chain.passes.begin(), chainPass(entry));
    const auto isFilter = [&](const ChainPass& pass) { return filters.contains(pass.name); };
    auto main = std::ranges::find_if_not(chain.passes, isFilter);
    if (main == chain.passes.end()) main = chain.passes.begin();
    for (auto filter = chain.passes.begin(); filter != main; ++filter)
        chain.filtered.insert(chain.filtered.begin(), filters.at(filter->name));
    if (main != chain.passes.end()) {
        chain.main = main->name;
        std::rotate(chain.passes.begin(), main, main + 1);
    }
    return chain;
}

/// Finds what differs among chains with the same main pass, and shows the first of its parameters.
void findDetails(const std::vector<Chain*>& chains, const FilterLabels& filters) {
    std::map<std::string, size_t> counts;  // Of the chains with a pass, "name", or a parameter, "name.spp 4".
    std::map<std::string, std::set<std::string>> owners;  // Passes with a parameter, by its name.
    for (const Chain* chain : chains) {
        std::set<std::string> texts;
        for (const ChainPass& pass : chain->passes) {
            texts.insert(pass.name);
            for (const ChainParameter& parameter : pass.parameters) {
                texts.insert(pass.name + "." + parameter.text());
                owners[parameter.name].insert(pass.name);
            }
        }
        for (const std::string& text : texts) ++counts[text];
    }
    for (Chain* chain : chains)
        for (const ChainPass& pass : chain->passes) {
            if (!filters.contains(pass.name) && counts[pass.name] < chains.size()) chain->hidden.push_back(pass.name);
            for (const ChainParameter& parameter : pass.parameters) {
                const std::string ownedText = pass.name + "." + parameter.text();
                if (counts[ownedText] == chains.size()) continue;
                chain->hidden.push_back(owners[parameter.name].size() > 1 ? ownedText : parameter.text());
            }
            if (&pass == &chain->passes.front() && !chain->hidden.empty()) chain->show(chain->hidden.begin());
        }
}

/// Shows one more detail of each chain that not all of these have. @return whether there was any.
bool showMore(const std::vector<Chain*>& chains) {
    std::map<std::string, size_t> counts;
    for (const Chain* chain : chains)
        for (const std::string& detail : std::set(chain->hidden.begin(), chain->hidden.end())) ++counts[detail];
    bool isAny = false;
    for (Chain* chain : chains) {
        const auto detail =
            std::ranges::find_if(chain->hidden, [&](const std::string& text) { return counts[text] < chains.size(); });
        if (detail == chain->hidden.end()) continue;
        chain->show(detail);
        isAny = true;
    }
    return isAny;
}

std::map<std::string, std::vector<size_t>> groupsOf(const std::vector<std::string>& labels) {
    std::map<std::string, std::vector<size_t>> groups;
    for (size_t i = 0; i < labels.size(); ++i) groups[labels[i]].push_back(i);
    return groups;
}

}  // namespace

std::vector<std::string> chainLabels(const std::vector<Value>& values, const FilterLabels& filters) {
    std::vector<Chain> chains;
    std::map<std::string, std::vector<Chain*>> byMain;
    for (const Value& value : values) chains.push_back(chainOf(value, filters));
    for (Chain& chain : chains) byMain[chain.main].push_back(&chain);
    for (const auto& [main, group] : byMain) findDetails(group, filters);

    std::vector<std::string> labels;
    for (bool isDone = false; !isDone;) {
        isDone = true;
        std::map<std::string, std::vector<Chain*>> byLabel;
        for (Chain& chain : chains) byLabel[chain.label()].push_back(&chain);
        for (const auto& [text, group] : byLabel)
            if (group.size() > 1 && showMore(group)) isDone = false;
    }
    for (const Chain& chain : chains) labels.push_back(chain.label());
    for (const auto& [text, group] : groupsOf(labels))
        if (group.size() > 1)
            for (const size_t i : group) labels[i] = values[i].text();
    return labels;
}

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
