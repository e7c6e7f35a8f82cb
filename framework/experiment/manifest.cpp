#include "experiment/manifest.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <utility>

#include "base/files.h"
#include "experiment/results.h"
#include "image/seed_error.h"
#include "image/temporal.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kIdentity = "identity";

template <typename Infos>
Json metricsJson(const Infos& infos) {
    Json list = Json::array();
    for (const MetricInfo& metric : infos)
        list.push_back({{"name", metric.name},
                        {"label", metric.label},
                        {"unit", metric.unit},
                        {"better", nameOf(metric.better)},
                        {"interval", metric.hasInterval},
                        {"meaning", metric.meaning}});
    return list;
}

Json exposuresJson(const FlipExposures& e) {
    return {{"start", e.start}, {"stop", e.stop}, {"count", e.count}};
}

/// An entry of `references`, without its variants.
Json entryJson(const ReferenceRecord& r, const Value& pass) {
    Json json;
    if (pass.isMap()) json = Json::parse(pass.json());
    json["folder"] = r.folder;
    json["hash"] = r.hash;
    json["seconds"] = r.seconds;
    json["cached"] = r.cached;
    json["mask_fractions"] = r.maskFractions;
    json.update(scoresJson(r.noise, kNoise));
    json["flip_exposures"] = exposuresJson(r.exposures);
    json["indirect_flip_exposures"] = exposuresJson(r.indirectExposures);
    json["baselines"] = {{"black", scoresJson(r.black)}, {"constant", scoresJson(r.constant)}};
    return json;
}

/// Sets `references`, and keys of the first one at the top level: most runs have a single one.
void setReferences(Json& manifest, const std::vector<ReferenceEntry>& references) {
    std::map<std::string, Json> variants;  // Names by hash of their reference.
    for (const auto& [variant, inputs] : manifest["inputs"].items())
        variants.try_emplace(inputs.at("reference").get<std::string>(), Json::array()).first->second.push_back(variant);
    manifest["references"] = Json::array();
    for (const ReferenceEntry& reference : references) {
        Json entry = Json::parse(reference.text);
        entry["folder"] = reference.folder;
        const auto found = variants.find(reference.hash);
        entry["variants"] = found == variants.end() ? Json::array() : found->second;
        manifest["references"].push_back(std::move(entry));
    }
    if (references.empty()) return;
    Json first = manifest["references"][0];
    for (const char* key : {"flip_exposures", "baselines"}) manifest[key] = first[key];
    for (const char* key : {"flip_exposures", "indirect_flip_exposures", "baselines", "variants"}) first.erase(key);
    manifest["reference"] = std::move(first);
}

/// Data of a run that is known once variants have finished, and that changes when results are merged.
struct Outcome {
    const std::string& finished;  ///< Time in UTC; empty: not yet.
    const Sessions& sessions;
    const std::vector<ReferenceEntry>& references;
    const std::vector<std::string>&warnings, &notes;
};

/// Sets the keys of the outcome. `inputs` must exist.
void setOutcome(Json& manifest, const Outcome& outcome) {
    manifest["finished"] = outcome.finished.empty() ? Json(nullptr) : Json(outcome.finished);
    manifest["sessions"] = Json::array();
    for (const auto& [began, variants] : outcome.sessions)
        manifest["sessions"].push_back({{"started", began}, {"variants", variants}});
    manifest["warnings"] = outcome.warnings;
    manifest["notes"] = outcome.notes;
    setReferences(manifest, outcome.references);
}

std::string textOf(const Json& manifest) {
    return manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The first difference of two nodes: a path and both values.
std::string firstDifference(const Json& a, const Json& b, const std::string& path) {
    if (a == b) return {};
    if (!a.is_object() || !b.is_object()) return fmt::format("{}: {} and {}", path, a.dump(), b.dump());
    for (const auto& [key, value] : a.items()) {
        const std::string below = path + "." + key;
        if (!b.contains(key)) return fmt::format("{}: {} and nothing", below, value.dump());
        if (std::string text = firstDifference(value, b.at(key), below); !text.empty()) return text;
    }
    for (const auto& [key, value] : b.items())
        if (!a.contains(key)) return fmt::format("{}.{}: nothing and {}", path, key, value.dump());
    return {};  // Only the order of keys differs.
}

std::string cpuName() {
    std::istringstream lines(readTextFile("/proc/cpuinfo"));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

}  // namespace

std::string manifestJson(const ManifestData& data) {
    const Experiment& experiment = data.study->experiment;
    Json json;
    json[kIdentity] = identityOf(data);
    json["voxray_version"] = data.version;
    json["commit"] = data.commit;
    json["started"] = data.started;
    for (const char* later : {"finished", "sessions"}) json[later] = nullptr;
    json["device"] = data.device.name;
    json["driver"] = data.device.driver;
    json["tracer"] = data.tracer;
    json["validation"] = data.validation;
    json["config_file"] = experiment.file.filename().string();
    json["config"] = Json::parse(experiment.config.json());
    json["sweep_keys"] = Json::array();
    for (const auto& member : experiment.sweep.members) json["sweep_keys"].push_back(member.key);
    json["seed"] = experiment.setup.general.seed;
    const ImageSettings& image = experiment.setup.image;
    json["image"] = {{"width", image.width}, {"height", image.height}};
    json["exposure_stops"] = image.exposureStops;
    json["tone"] = enumName(image.tone);
    Value measure = writeParams(experiment.measure);
    json["measure"] = Json::parse(measure.json());
    json["measure"]["metrics"] = experiment.measure.metrics;
    json["metrics"] = metricsJson(metrics());
    json["seed_metrics"] = metricsJson(seedMetrics());
    json["temporal_metrics"] = metricsJson(temporalMetrics());

    json["auto"] = {{"tracer", data.tracer}, {"device", data.device.name}};
    json["requested"] = {{"tracer", enumName(experiment.setup.general.tracer)},
                         {"device", data.requestedDevice.empty() ? "best" : data.requestedDevice}};
    // Ids are unique, so that they are appended without a search
    Json::object_t names, graphs, inputs;
    // By image, then by variant
    std::map<std::string, std::map<std::string, std::vector<std::string>>> noise;
    for (const Variant& variant : data.study->variants) {
        const std::string& id = variant.id;
        names.emplace_back(id, variant.name);
        graphs.emplace_back(id, Json::parse(variant.resolved.json(-1)));
        inputs.emplace_back(
            id, Json{{"scene", variant.sceneKey}, {"reference", variant.referenceHash}, {"values", variant.values}});
        for (const auto& [image, parameters] : variant.noiseParameters) noise[image][id] = parameters;
    }
    json["names"] = std::move(names);
    json["variants"] = std::move(graphs);
    json["inputs"] = std::move(inputs);
    json["noise_parameters"] = noise;
    json["light_independent"] = Json::array();
    for (const PassKind& kind : data.study->registry->kinds())
        if (!kind.dependsOnLight) json["light_independent"].push_back(kind.name);
    for (const char* later : {"warnings", "notes"}) json[later] = nullptr;
    json["versions"] = {{"voxray", data.version}, {"driver", data.device.driver}, {"compiler", __VERSION__}};
    json["machine"] = {{"cpu", cpuName()}, {"cores", std::thread::hardware_concurrency()}};
    setOutcome(json, {data.finished, data.sessions, data.references, data.warnings, data.notes});
    return textOf(json);
}

std::string identityOf(const ManifestData& data) {
    Hasher hasher;
    hasher.add(data.version).add(data.commit).add(data.study->experiment.config.json());
    for (const Variant& variant : data.study->variants)
        hasher.add(variant.id).add(variant.sceneKey).add(variant.referenceHash).add(variant.resolved.json(-1));
    return hasher.hex();
}

std::string referenceJson(const ReferenceRecord& record, const Value& pass) {
    return entryJson(record, pass).dump(2) + "\n";
}

std::vector<ReferenceEntry> referencesIn(const fs::path& images) {
    std::vector<ReferenceEntry> entries;
    std::error_code code;
    for (const auto& at : fs::directory_iterator(images, code)) {
        const std::string folder = at.path().filename().string();
        if (!folder.starts_with("reference")) continue;
        std::string text;
        try {
            text = readTextFile(at.path() / "reference.json");
        } catch (const Error&) {  // Another process may be replacing it.
            continue;
        }
        const Json json = Json::parse(text, nullptr, false);
        if (json.is_object() && json.contains("hash"))
            entries.push_back({folder, json["hash"].get<std::string>(), std::move(text)});
    }
    // reference, reference.2, ..., reference.10
    std::ranges::sort(entries, {},
                      [](const ReferenceEntry& entry) { return std::pair(entry.folder.size(), entry.folder); });
    return entries;
}

std::string identityIn(const std::string& manifest) {
    return jsonTextAt(manifest, {kIdentity});
}

std::string experimentIn(const std::string& manifest) {
    return jsonTextAt(manifest, {"config", "name"});
}

Json parseManifest(const std::string& text) {
    Json manifest = Json::parse(text, nullptr, false);
    if (!manifest.is_object() || !manifest.contains("inputs") || !manifest.contains("names"))
        throw Error("the manifest is broken, or of an older version of Voxray");
    return manifest;
}

std::string manifestDifference(const Json& first, const Json& second) {
    for (const char* key : {"voxray_version", "commit", "config", "inputs"})
        if (std::string text = firstDifference(first.at(key), second.at(key), key); !text.empty()) return text;
    return {};
}

Sessions sessionsOf(const std::vector<VariantResult>& results) {
    Sessions sessions;
    for (const VariantResult& result : results) sessions[result.session].push_back(result.variant);
    return sessions;
}

std::string mergedManifest(Json first, const std::vector<ReferenceEntry>& references, const Sessions& sessions,
                           const std::vector<std::string>& warnings, const std::vector<std::string>& notes,
                           bool isWhole) {
    const std::string finished = isWhole ? utcNow() : "";
    setOutcome(first, {finished, sessions, references, warnings, notes});
    return textOf(first);
}

std::string commitOf(const fs::path& sourceRoot) {
    try {
        // A worktree's .git is a file that names the folder, which names the one with the branches
        fs::path git = sourceRoot / ".git";
        const auto firstLine = [](const fs::path& path) {
            const std::string text = readTextFile(path);
            return text.substr(0, text.find('\n'));
        };
        if (!fs::is_directory(git)) git = sourceRoot / firstLine(git).substr(8);
        const std::string head = firstLine(git / "HEAD");
        if (!head.starts_with("ref: ")) return head;
        const std::string branch = head.substr(5);
        if (fs::exists(git / "commondir")) git /= firstLine(git / "commondir");
        if (fs::exists(git / branch)) return firstLine(git / branch);
        std::istringstream packed(readTextFile(git / "packed-refs"));
        for (std::string line; std::getline(packed, line);)
            if (line.size() > 41 && line.substr(41) == branch) return line.substr(0, 40);
    } catch (const std::exception&) {
        return "unknown";
    }
    return "unknown";
}

std::string utcNow() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

}  // namespace voxray
