#include "config/sweep.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/files.h"
#include "base/suggest.h"
#include "config/overrides.h"

namespace voxray {
namespace {

constexpr size_t kMaxVariants = 10000;
constexpr size_t kMaxIdLength = 120;

struct Axis {
    std::string path;
    std::string label;  ///< Short name that is used in names of variants.
    bool isWord;        ///< Its values' labels need no parameter before them, unless they are numbers.
    std::vector<Value> values;
    std::vector<std::string> texts;  ///< Labels of the values.
    TextLocation where;
};

void checkPath(const std::string& path, const TextLocation& where) {
    static const std::vector<std::string> fixed{"name", "graph", "reference", "sweep", "measure", "profiles"};
    const std::string first = path.substr(0, path.find('.'));
    if (std::ranges::count(fixed, first) > 0)
        throw UsageError(
            where, "sweep: '{}' is the same for all variants; sweep over a pass, scene, image, seed or tracer", path);
}

/// Whether an axis' values are passes or chains of passes.
bool isPassPath(const std::string& path) {
    return path.find('.') == std::string::npos && std::ranges::count(configKeys(), path) == 0;
}

/// The text as the name of a folder: not empty, without a leading '-' or '.', and none of a reference's folders,
/// which begin with "reference".
std::string fileSafe(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        const bool isPlain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
                             c == '.' || c == '-';
        if (isPlain)
            safe += c;
        else if (!safe.empty() && safe.back() != '-')
            safe += '-';
    }
    while (!safe.empty() && safe.back() == '-') safe.pop_back();
    safe.erase(0, safe.find_first_not_of('-'));
    const bool isTaken = safe.empty() || safe.front() == '.' || safe.starts_with("reference");
    return isTaken ? "variant" + (safe.empty() ? "" : "-" + safe) : safe;
}

std::vector<Axis> readAxes(const Experiment& experiment, const FilterLabels& filters) {
    std::vector<Axis> axes;
    std::map<std::string, int> labels;
    for (const auto& [path, list] : experiment.sweep.members) {
        checkPath(path, list.where);
        const std::string label = lastKey(experiment.config, path);
        ++labels[label];
        const bool isWord = list.isMap() || isPassPath(path) || path == "scene";
        axes.push_back({path, label, isWord, sweepValues(list), sweepLabels(path, list, filters), list.where});
        const std::set<std::string> unique(axes.back().texts.begin(), axes.back().texts.end());
        if (unique.size() != axes.back().texts.size())
            throw UsageError(list.where, "sweep.{}: a value appears twice", path);
        if (unique.contains(kNoValue))
            throw UsageError(list.where, "sweep.{}: '{}' names no value, it stands for variants without one", path,
                             kNoValue);
        for (size_t i = 0; i < list.members.size(); ++i)
            for (size_t j = 0; j < i; ++j)
                if (list.members[i].value == list.members[j].value)
                    throw UsageError(list.members[i].value.where, "sweep.{}: '{}' and '{}' are the same", path,
                                     list.members[j].key, list.members[i].key);
    }
    for (Axis& axis : axes)
        if (labels[axis.label] > 1) axis.label = axis.path;
    return axes;
}

/// Indices of values of a combination: the digits of `index`. The last axis varies fastest.
std::vector<size_t> choose(const std::vector<Axis>& axes, size_t index) {
    std::vector<size_t> chosen(axes.size());
    for (size_t a = axes.size(); a-- > 0;) {
        chosen[a] = index % axes[a].values.size();
        index /= axes[a].values.size();
    }
    return chosen;
}

/// Whether the axis sets a whole pass or another whole entry of the config, before parameters are set in it.
bool setsWholeEntry(const Axis& axis) {
    return axis.path.find('.') == std::string::npos;
}

/// Sets the value of an axis in a config. Errors of paths are located at the axis, others at the value.
void setValue(Value& config, const Axis& axis, size_t chosen) {
    Value value = axis.values[chosen];
    if (!hasTarget(config, axis.path)) value.where = axis.where;
    applyOverride(config, axis.path, value, Merge::Replace);
}

/// Configs without sweep and with whole entries replaced, shared by variants that differ only in other values.
class BaseConfigs {
 public:
    BaseConfigs(const Experiment& experiment, const std::vector<Axis>& axes) : axes_(axes), plain_(experiment.config) {
        plain_.erase("sweep");
    }

    /// @param chosen index of the value of each axis; axes that set parameters are ignored.
    const Value& with(std::vector<size_t> chosen) {
        for (size_t a = 0; a < axes_.size(); ++a)
            if (!setsWholeEntry(axes_[a])) chosen[a] = 0;
        const auto [config, isNew] = configs_.try_emplace(chosen);
        if (isNew) {
            config->second = plain_;
            for (size_t a = 0; a < axes_.size(); ++a)
                if (setsWholeEntry(axes_[a])) setValue(config->second, axes_[a], chosen[a]);
        }
        return config->second;
    }
    /// Whether any config so far has the target of an axis.
    bool anyHasTarget(const std::string& path) const {
        return std::ranges::any_of(configs_, [&](const auto& c) { return hasTarget(c.second, path); });
    }

 private:
    const std::vector<Axis>& axes_;
    Value plain_;
    std::map<std::vector<size_t>, Value> configs_;  ///< By the indices of values of whole entries.
};

std::string shortened(const std::string& id) {
    if (id.size() <= kMaxIdLength) return id;
    return id.substr(0, kMaxIdLength - 9) + "-" + Hasher().add(id).hex().substr(0, 8);
}

bool isNumber(const std::string& text) {
    return text.find_first_of("0123456789") != std::string::npos &&
           text.find_first_not_of("0123456789.-+e") == std::string::npos;
}

}  // namespace

std::vector<std::string> sweepKeys(const Experiment& experiment) {
    std::vector<std::string> keys;
    for (const auto& member : experiment.sweep.members) keys.push_back(member.key);
    return keys;
}

std::vector<Value> sweepValues(const Value& axis) {
    std::vector<Value> values = axis.items;
    for (const auto& member : axis.members) values.push_back(member.value);
    return values;
}

std::vector<std::string> sweepLabels(const std::string& path, const Value& axis, const FilterLabels& filters) {
    if (!axis.isMap()) return isPassPath(path) ? chainLabels(axis.items, filters) : valueLabels(axis.items);
    std::vector<std::string> names;
    for (const auto& member : axis.members) names.push_back(member.key);
    return names;
}

void selectSweepValues(Value& config, const std::vector<std::string>& choices, const FilterLabels& filters) {
    std::map<std::string, std::set<std::string>> chosen;
    for (const std::string& choice : choices) {
        const size_t equals = choice.find('=');
        if (equals == std::string::npos)
            throw UsageError("--only {}: expected AXIS=VALUE, as in voxelize.resolution=64", choice);
        chosen[choice.substr(0, equals)].insert(choice.substr(equals + 1));
    }
    for (const auto& [path, values] : chosen) {
        Value* sweep = config.find("sweep");
        Value* axis = sweep ? sweep->find(path) : nullptr;
        std::vector<std::string> names;
        for (const auto& member : sweep ? sweep->members : std::vector<Value::Member>()) names.push_back(member.key);
        if (!axis) throw UsageError("--only: the sweep has no axis '{}'{}", path, didYouMean(path, names));
        const std::vector<std::string> labels = sweepLabels(path, *axis, filters);
        for (const std::string& value : values)
            if (std::ranges::count(labels, value) == 0)
                throw UsageError("--only: '{}' has no value '{}'{}", path, value, didYouMean(value, labels));
        for (size_t i = labels.size(); i-- > 0;) {
            if (values.contains(labels[i])) continue;
            if (axis->isMap())
                axis->members.erase(axis->members.begin() + ptrdiff_t(i));
            else
                axis->items.erase(axis->items.begin() + ptrdiff_t(i));
        }
    }
}

std::vector<SweepPoint> expandSweep(const Experiment& experiment, const FilterLabels& filters) {
    const std::vector<Axis> axes = readAxes(experiment, filters);
    size_t count = 1;
    for (const Axis& axis : axes) {
        count *= axis.values.size();
        if (count > kMaxVariants)
            throw UsageError(experiment.sweep.where, "sweep: more than {} variants", kMaxVariants);
    }

    // Passes are replaced first, so that parameters apply to the final pass. An axis of a pass that only some
    // graphs have does not multiply the variants of other graphs
    BaseConfigs configs(experiment, axes);
    for (size_t index = 0; index < count; ++index) configs.with(choose(axes, index));
    std::vector<bool> isKnown(axes.size());
    for (size_t a = 0; a < axes.size(); ++a) isKnown[a] = configs.anyHasTarget(axes[a].path);

    std::vector<SweepPoint> variants;
    for (size_t index = 0; index < count; ++index) {
        const std::vector<size_t> chosen = choose(axes, index);
        SweepPoint variant;
        variant.config = configs.with(chosen);
        bool isRepeat = false;
        for (size_t a = 0; a < axes.size(); ++a) {
            if (!setsWholeEntry(axes[a])) {
                if (isKnown[a] && !hasTarget(variant.config, axes[a].path)) {
                    isRepeat = isRepeat || chosen[a] > 0;
                    variant.values.push_back(kNoValue);
                    continue;
                }
                setValue(variant.config, axes[a], chosen[a]);
            }
            variant.values.push_back(axes[a].texts[chosen[a]]);
        }
        if (isRepeat) continue;
        variant.setup = readSetup(variant.config);
        variants.push_back(std::move(variant));
    }
    VariantNames names(experiment, filters);
    for (SweepPoint& variant : variants) names.name(variant);
    return variants;
}

VariantNames::VariantNames(const Experiment& experiment, const FilterLabels& filters) {
    for (const auto& axis : readAxes(experiment, filters)) axes_.push_back({axis.label, axis.isWord});
}

void VariantNames::name(SweepPoint& variant) {
    std::string name;
    for (size_t a = 0; a < axes_.size(); ++a) {
        const std::string& value = variant.values[a];
        if (value == kNoValue) continue;
        const bool isAlone = axes_[a].isWord && !isNumber(value);
        name += (name.empty() ? "" : ", ") + (isAlone ? value : axes_[a].label + " " + value);
    }
    if (name.empty()) name = "default";

    // Keys of two axes may be equal, and so may different names after fileSafe()
    variant.name = name;
    for (int copy = 2; !names_.insert(variant.name).second; ++copy) variant.name = fmt::format("{} ({})", name, copy);
    const std::string id = shortened(fileSafe(variant.name));
    variant.id = id;
    for (int copy = 2; !ids_.insert(variant.id).second; ++copy) variant.id = fmt::format("{}-{}", id, copy);
}

}  // namespace voxray
