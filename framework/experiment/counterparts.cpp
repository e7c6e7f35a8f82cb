#include "experiment/counterparts.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "config/overrides.h"

namespace voxray {
namespace {

using Entries = std::vector<Value>;

/// The pass of the graph that a sweep swaps for whole graphs.
constexpr const char* kPlaceholder = "explained";

const Value& required(const Value& map, const char* key) {
    const Value* value = map.find(key);
    if (!value) throw UsageError(map.where, "'{}' is missing", key);
    return *value;
}

std::vector<std::string> namesIn(const Value* list) {
    std::vector<std::string> names;
    if (list)
        for (const Value& item : list->items) names.push_back(item.asString("counterparts"));
    return names;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

std::string passOf(const Value& entry) {
    return required(entry, "pass").asString("pass");
}

Value resolved(const Value& entry, const Registry& registry) {
    return registry.require(passOf(entry), entry.where).resolve(entry, passId(entry), Graph::reservedKeys());
}

Value number(double value) {
    return Value::fromScalar(value == std::floor(value) && std::abs(value) < 1e15
                                 ? fmt::format("{}", int64_t(value))
                                 : fmt::format("{:.9g}", value));
}

/// What a parameter becomes: a plain value, or a number that goes by the parameter's own.
Value valueOf(const Value& rule, const Value& own, const std::string& name) {
    if (!rule.isMap()) return rule;
    if (const Value* least = rule.find("least"))
        return number(std::max(own.asNumber(name), least->asNumber("least")));
    const double was = own.asNumber(name), times = required(rule, "times").asNumber("times");
    const Value* most = rule.find("most");
    return number(most ? std::max(was, std::min(was * times, most->asNumber("most"))) : was * times);
}

/// Parameters that the new values leave without effect must not be written.
void dropIdle(Value& entry, const Registry& registry) {
    const PassKind& kind = registry.require(passOf(entry), entry.where);
    for (const UnusedSetting& unused : kind.unused(entry, passId(entry), Graph::reservedKeys()))
        entry.erase(unused.name);
}

Value withParameters(const Value& entry, const Value& rule, const Registry& registry) {
    Value changed = entry;
    const Value own = resolved(entry, registry);
    for (const auto& [name, value] : rule.members)
        changed.set(name, valueOf(value, required(own, name.c_str()), name)).where = entry.where;
    dropIdle(changed, registry);
    return changed;
}

/// The last pass of the chain gets the id, so that later passes find it.
Entries withChain(const Value& entry, const Value& chain, const Registry& registry) {
    const Value own = resolved(entry, registry);
    Entries passes;
    for (Value pass : chain.items) {
        for (auto& [key, value] : pass.members)
            if (value.scalar == "own") value = required(own, key.c_str());
        pass.where = entry.where;
        passes.push_back(std::move(pass));
    }
    passes.back().set("id", Value::fromScalar(passId(entry)));
    return passes;
}

/// One stage swapped: each pass that the stage's rules name becomes what they say.
Entries swapped(const Entries& graph, const Value& stage, const Registry& registry) {
    Entries out;
    for (const Value& entry : graph) {
        const Value* rule = required(stage, "passes").find(passOf(entry));
        if (!rule)
            out.push_back(entry);
        else if (rule->isMap())
            out.push_back(withParameters(entry, *rule, registry));
        else if (rule->isList())
            std::ranges::copy(withChain(entry, *rule, registry), std::back_inserter(out));
    }
    return out;
}

std::vector<std::string> changesBetween(const Entries& before, const Entries& after,
                                        const Registry& registry) {
    std::vector<std::string> changes;
    for (const Value& entry : before) {
        const std::string id = passId(entry);
        const auto same = std::ranges::find_if(after, [&](const Value& e) { return passId(e) == id; });
        if (same == after.end()) {
            changes.push_back(fmt::format("without {}", passOf(entry)));
        } else if (passOf(*same) != passOf(entry)) {
            changes.push_back(fmt::format("{} in place of {}", passOf(*same), passOf(entry)));
        } else {
            const Value was = resolved(entry, registry), is = resolved(*same, registry);
            for (const auto& [name, value] : is.members)
                if (const Value* old = was.find(name); old && !(*old == value))
                    changes.push_back(fmt::format("{}.{} {} → {}", id, name, old->text(), value.text()));
        }
    }
    return changes;
}

/// The variant's passes that its image depends on. @throws UsageError where the table knows none of their
/// counterparts.
Entries passesOf(const Value& table, const Variant& variant) {
    std::vector<std::string> known = namesIn(table.find("exact"));
    for (const auto& [name, stage] : required(table, "stages").members)
        for (const auto& rule : required(stage, "passes").members) known.push_back(rule.key);
    Entries passes;
    for (const Value& entry : variant.setup.graph.items) {
        if (holds(variant.leftOut, passId(entry))) continue;
        if (!holds(known, passOf(entry)))
            throw UsageError(
                entry.where,
                "'{}' has no exact counterpart, so its error can't be told from the others': swap "
                "it with --set {}=OTHER, or add it to {}",
                passOf(entry), passId(entry), table.where.file);
        passes.push_back(entry);
    }
    return passes;
}

std::string labelOf(const std::vector<std::string>& stages) {
    return stages.empty() ? "as it is" : fmt::format("{}", fmt::join(stages, " + "));
}

Experiment experimentOf(const Study& wired, const Variant& variant, const Value& graphs) {
    Value config = variant.config;
    config.set("name", Value::fromScalar(("explain_" + variant.setup.general.name).substr(0, 100), true));
    Value placeholder = Value::map(), graph = Value::list(), sweep = Value::map(), measure = Value::map();
    placeholder.set("pass", required(graphs.members.front().value.items.back(), "pass"));
    placeholder.set("id", Value::fromScalar(kPlaceholder));
    graph.items.push_back(std::move(placeholder));
    sweep.set(kPlaceholder, graphs);
    measure.set("frames", number(1));
    measure.set("warmup", number(0));
    measure.set("memory_limit_mb", number(double(wired.experiment.measure.memoryLimitMb)));
    config.set("graph", std::move(graph));
    config.set("sweep", std::move(sweep));
    config.set("measure", std::move(measure));
    Experiment experiment = readExperiment(std::move(config));
    experiment.file = wired.experiment.file;
    return experiment;
}

Value quotedList(const std::vector<std::string>& words) {
    Value list = Value::list();
    for (const std::string& word : words) list.items.push_back(Value::fromScalar(word, true));
    return list;
}

}  // namespace

SwapPlan planSwaps(const Value& table, const Study& wired, const Variant& variant, const Registry& registry) {
    if (wired.experiment.reference.isNull())
        throw UsageError(wired.experiment.config.where,
                         "there is no 'reference', so there is no error to explain: write one, as in "
                         "{{pass: path_trace, spp: 1024, bounces: 8}}");
    const Entries own = passesOf(table, variant);
    const auto& rules = required(table, "stages").members;
    const auto graphOf = [&](const std::vector<std::string>& stages) {
        Entries graph = own;
        for (const auto& [name, stage] : rules)
            if (holds(stages, name)) graph = swapped(graph, stage, registry);
        return graph;
    };

    // Stages whose counterpart changes something, after those that they need
    SwapPlan plan;
    std::vector<std::string> present;
    for (const auto& [name, stage] : rules) {
        std::vector<std::string> needs = namesIn(stage.find("needs"));
        std::erase_if(needs, [&](const std::string& need) { return !holds(present, need); });
        std::vector<std::string> all = needs;
        all.push_back(name);
        const Entries before = graphOf(needs), after = graphOf(all);
        if (before == after) continue;
        plan.stages.push_back(
            {name, required(stage, "cure").asString("cure"), needs, changesBetween(before, after, registry)});
        present.push_back(name);
    }
    if (plan.stages.empty())
        throw UsageError(variant.setup.graph.where,
                         "nothing to explain: every stage of this graph is as fine as its counterpart");

    // Every set of stages that holds what its stages need
    Value graphs = Value::map();
    for (size_t bits = 0; bits < size_t(1) << plan.stages.size(); ++bits) {
        std::vector<std::string> stages;
        bool isWhole = true;
        for (size_t i = 0; i < plan.stages.size(); ++i) {
            if ((bits >> i & 1) == 0) continue;
            for (const std::string& need : plan.stages[i].needs) isWhole = isWhole && holds(stages, need);
            stages.push_back(plan.stages[i].name);
        }
        if (!isWhole) continue;
        Value chain = Value::list();
        chain.items = graphOf(stages);
        graphs.set(labelOf(stages), std::move(chain));
        plan.swaps.push_back(std::move(stages));
    }
    plan.experiment = experimentOf(wired, variant, graphs);
    return plan;
}

std::string SwapPlan::json() const {
    Value stageList = Value::list(), swapMap = Value::map(), whole = Value::map();
    for (const SwappedStage& stage : stages) {
        Value entry = Value::map();
        entry.set("name", Value::fromScalar(stage.name, true));
        entry.set("cure", Value::fromScalar(stage.cure, true));
        entry.set("needs", quotedList(stage.needs));
        entry.set("changes", quotedList(stage.changes));
        stageList.items.push_back(std::move(entry));
    }
    for (const auto& set : swaps) swapMap.set(labelOf(set), quotedList(set));
    whole.set("stages", std::move(stageList));
    whole.set("variants", std::move(swapMap));
    return whole.json();
}

std::vector<std::string> passesInTable(const Value& table) {
    std::vector<std::string> names = namesIn(table.find("exact"));
    for (const std::string& name : namesIn(table.find("unknown"))) names.push_back(name);
    std::set<std::string> listed;
    for (const auto& [stageName, stage] : required(table, "stages").members)
        for (const auto& rule : required(stage, "passes").members) listed.insert(rule.key);
    names.insert(names.end(), listed.begin(), listed.end());
    std::set<std::string> once;
    for (const std::string& name : names)
        if (!once.insert(name).second)
            throw UsageError(table.where, "'{}' is listed as more than one of stages, exact and unknown",
                             name);
    return names;
}

}  // namespace voxray
