#include "experiment/manifest.h"

#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/files.h"
#include "image/seed_error.h"
#include "image/temporal.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// Of the keys under which a reference's noise floors stand, behind the metric's column.
constexpr const char* kNoiseSuffix = "_noise";

// JSON has no infinity: it is written as text.
Json scoresJson(const Scores& scores, const std::string& suffix = "") {
    Json json = Json::object();
    for (const auto& [column, value] : scores)
        json[column + suffix] = std::isfinite(value) ? Json(value) : Json(numberText(value));
    return json;
}

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

Json referenceJson(const ReferenceRecord& r, const Value& pass) {
    Json json;
    if (pass.isMap()) json = Json::parse(pass.json());
    json["folder"] = r.folder;
    json["hash"] = r.hash;
    json["seconds"] = r.seconds;
    json["cached"] = r.cached;
    json["mask_fractions"] = r.maskFractions;
    json.update(scoresJson(r.noise, kNoiseSuffix));
    return json;
}

Scores scoresFrom(const Json& json) {
    Scores scores;
    for (const auto& [column, value] : json.items())
        scores[column] = value.is_number() ? value.get<double>() : std::stod(value.get<std::string>());
    return scores;
}

Scores noiseFrom(const Json& record) {
    Scores noise;
    const std::string suffix = kNoiseSuffix;
    for (const auto& [key, value] : record.items())
        if (key.ends_with(suffix)) noise[key.substr(0, key.size() - suffix.size())] = value.get<double>();
    return noise;
}

FlipExposures exposuresFrom(const Json& json) {
    return {json.at("start").get<double>(), json.at("stop").get<double>(), json.at("count").get<int>()};
}

std::string cpuName() {
    std::istringstream lines(readTextFile("/proc/cpuinfo"));
    for (std::string line; std::getline(lines, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown";
}

}  // namespace

std::string manifestJson(const ManifestData& data) {
    const Experiment& experiment = *data.experiment;
    Json json;
    json["voxray_version"] = data.version;
    json["commit"] = data.commit;
    json["started"] = data.started;
    json["finished"] = data.finished.empty() ? Json(nullptr) : Json(data.finished);
    json["sessions"] = Json::array();
    for (const auto& [began, variants] : data.sessions)
        json["sessions"].push_back({{"started", began}, {"variants", variants}});
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
    Value measure = writeParams(experiment.measure);
    json["measure"] = Json::parse(measure.json());
    json["measure"]["metrics"] = experiment.measure.metrics;
    json["metrics"] = metricsJson(metrics());
    json["seed_metrics"] = metricsJson(seedMetrics());
    json["temporal_metrics"] = metricsJson(temporalMetrics());

    // What most runs have: one reference
    if (!data.references.empty()) {
        const ReferenceRecord& first = data.references[0];
        json["flip_exposures"] = exposuresJson(first.exposures);
        json["reference"] = referenceJson(first, data.referencePass);
        json["baselines"] = {{"black", scoresJson(first.black)}, {"constant", scoresJson(first.constant)}};
    }
    json["references"] = Json::array();
    for (const ReferenceRecord& r : data.references) {
        Json entry = referenceJson(r, data.referencePass);
        entry["variants"] = Json::array();
        for (const auto& [variant, hash] : data.referenceHashes)
            if (hash == r.hash) entry["variants"].push_back(variant);
        entry["flip_exposures"] = exposuresJson(r.exposures);
        entry["indirect_flip_exposures"] = exposuresJson(r.indirectExposures);
        entry["baselines"] = {{"black", scoresJson(r.black)}, {"constant", scoresJson(r.constant)}};
        json["references"].push_back(entry);
    }
    json["auto"] = {{"tracer", data.tracer}, {"device", data.device.name}};
    json["requested"] = {{"tracer", schema_detail::textOf(experiment.setup.general.tracer)},
                         {"device", data.requestedDevice.empty() ? "best" : data.requestedDevice}};
    json["variants"] = Json::object();
    for (const auto& [name, graph] : data.graphs) json["variants"][name] = Json::parse(graph.json());
    json["noise_parameters"] = data.noiseParameters;
    json["warnings"] = data.warnings;
    json["notes"] = data.notes;
    json["versions"] = {{"voxray", data.version}, {"driver", data.device.driver}, {"compiler", __VERSION__}};
    json["machine"] = {{"cpu", cpuName()}, {"cores", std::thread::hardware_concurrency()}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<ReferenceRecord> referencesOf(const std::string& manifestText) {
    std::vector<ReferenceRecord> records;
    try {
        const Json manifest = Json::parse(manifestText);
        for (const Json& json : manifest.at("references")) {
            ReferenceRecord r;
            r.folder = json.at("folder").get<std::string>();
            r.hash = json.at("hash").get<std::string>();
            r.seconds = json.at("seconds").get<double>();
            r.cached = json.at("cached").get<bool>();
            r.maskFractions = json.at("mask_fractions").get<std::map<std::string, double>>();
            r.noise = noiseFrom(json);
            r.exposures = exposuresFrom(json.at("flip_exposures"));
            r.indirectExposures = exposuresFrom(json.at("indirect_flip_exposures"));
            const Json& baselines = json.at("baselines");
            r.black = scoresFrom(baselines.at("black"));
            r.constant = scoresFrom(baselines.at("constant"));
            records.push_back(r);
        }
    } catch (const std::exception&) {
        return {};
    }
    return records;
}

std::string commitOf(const fs::path& sourceRoot) {
    try {
        // A worktree's .git is a file that names the folder
        fs::path git = sourceRoot / ".git";
        const auto firstLine = [](const fs::path& path) {
            const std::string text = readTextFile(path);
            return text.substr(0, text.find('\n'));
        };
        if (!fs::is_directory(git)) git = sourceRoot / firstLine(git).substr(8);
        const std::string head = firstLine(git / "HEAD");
        if (head.rfind("ref: ", 0) != 0) return head;
        const std::string branch = head.substr(5);
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
