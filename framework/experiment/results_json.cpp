#include <cmath>
#include <nlohmann/json.hpp>

#include "experiment/results.h"

namespace voxray {
namespace {

using Json = nlohmann::ordered_json;
using PlainJson = nlohmann::json;

double numberFrom(const Json& json) {
    if (!json.is_string()) return json.get<double>();
    const std::string text = json.get<std::string>();
    return text == "inf" ? HUGE_VAL : text == "-inf" ? -HUGE_VAL : std::nan("");
}

Scores scoresFrom(const Json& json) {
    Scores scores;
    for (const auto& [column, value] : json.items()) scores[column] = numberFrom(value);
    return scores;
}

Json percentilesJson(const Percentiles& p) {
    return Json{p.p05, p.median, p.p95};
}
Percentiles percentilesFrom(const Json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

/// Finds the text at a path of keys and stops parsing there. Handlers return whether to continue.
class TextSearch final : public PlainJson::json_sax_t {
 public:
    explicit TextSearch(const std::vector<std::string>& path) : path_(path) {}
    const std::string& found() const { return found_; }

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool string(string_t& text) override {
        if (keys_ != path_) return true;
        found_ = std::move(text);
        return false;
    }
    bool start_object(size_t) override { return enter(); }
    bool end_object() override { return leave(); }
    bool start_array(size_t) override { return enter(); }
    bool end_array() override { return leave(); }
    bool key(string_t& text) override {
        keys_.back() = std::move(text);
        return true;
    }
    bool parse_error(size_t, const std::string&, const PlainJson::exception&) override { return false; }

 private:
    bool enter() {
        keys_.emplace_back();
        return true;
    }
    bool leave() {
        keys_.pop_back();
        return true;
    }

    const std::vector<std::string>& path_;
    std::vector<std::string> keys_;  ///< The current key of each enclosing object; "" for lists.
    std::string found_;
};

}  // namespace

const char* nameOf(Phase phase) {
    return phase == Phase::Build ? "build" : "frame";
}

std::string jsonTextAt(std::string_view json, const std::vector<std::string>& path) {
    TextSearch search(path);
    PlainJson::sax_parse(json, &search);
    return search.found();
}

Json numberJson(double value) {
    return std::isfinite(value) ? Json(value) : Json(numberText(value));
}

Json scoresJson(const Scores& scores, const std::string& suffix) {
    Json json = Json::object();
    for (const auto& [column, value] : scores) json[column + suffix] = numberJson(value);
    return json;
}

std::string resultJson(const VariantResult& r, const VariantInputs& inputs) {
    Json json;
    json["variant"] = r.variant;
    json["name"] = r.name;
    json["device"] = r.device;
    json["tracer"] = r.tracer;
    json["sweep_values"] = r.sweepValues;
    json["session"] = r.session;
    json["build_ms"] = r.buildMs;
    json["frame_ms"] = percentilesJson(r.frameMs);
    json["memory_bytes"] = r.memoryBytes;
    json["peak_bytes"] = r.peakBytes;
    json["rays"] = r.rays;
    json["tracer_build_ms"] = r.tracerBuildMs;
    json["tracer_bytes"] = r.tracerBytes;
    json["scores"] = scoresJson(r.scores);
    json["passes"] = Json::array();
    for (const PassCost& p : r.passes)
        json["passes"].push_back({{"pass", p.id},
                                  {"phase", nameOf(p.phase)},
                                  {"ms", percentilesJson(p.milliseconds)},
                                  {"rays", p.rays},
                                  {"voxel_steps", p.voxelSteps},
                                  {"memory_bytes", p.memoryBytes},
                                  {"scratch_bytes", p.scratchBytes},
                                  {"dispatches", p.work.dispatches},
                                  {"host_waits", p.work.waits},
                                  {"host_bytes", p.work.hostBytes},
                                  {"clock", p.clock}});
    json["values"] = Json::array();
    for (const ReportedValue& v : r.values) {
        json["values"].push_back({{"pass", v.pass}, {"name", v.name}, {"value", v.value}});
        if (v.frame) json["values"].back()["frame"] = *v.frame;
    }
    json["frames"] = Json::array();
    for (const FrameScores& frame : r.frames)
        json["frames"].push_back({{"frame", frame.frame}, {"scores", scoresJson(frame.scores)}});
    json["inputs"] = Json::object();
    for (const auto& [name, text] : inputs) json["inputs"][name] = text;
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::pair<VariantResult, VariantInputs> parseResultJson(const std::string& text) {
    try {
        const Json json = Json::parse(text);
        VariantResult r;
        r.ok = true;
        r.variant = json.at("variant").get<std::string>();
        r.name = json.value("name", r.variant);
        r.device = json.at("device").get<std::string>();
        r.tracer = json.at("tracer").get<std::string>();
        r.sweepValues = json.at("sweep_values").get<std::vector<std::string>>();
        r.session = json.value("session", std::string());
        r.buildMs = json.at("build_ms").get<double>();
        r.frameMs = percentilesFrom(json.at("frame_ms"));
        r.memoryBytes = json.at("memory_bytes").get<uint64_t>();
        r.peakBytes = json.at("peak_bytes").get<uint64_t>();
        r.rays = json.at("rays").get<uint64_t>();
        r.tracerBuildMs = json.at("tracer_build_ms").get<double>();
        r.tracerBytes = json.at("tracer_bytes").get<uint64_t>();
        r.scores = scoresFrom(json.at("scores"));
        for (const Json& p : json.at("passes")) {
            const Phase phase = p.at("phase").get<std::string>() == "build" ? Phase::Build : Phase::Frame;
            r.passes.push_back({p.at("pass").get<std::string>(),
                                phase,
                                percentilesFrom(p.at("ms")),
                                p.at("rays").get<uint64_t>(),
                                p.at("voxel_steps").get<uint64_t>(),
                                p.at("memory_bytes").get<uint64_t>(),
                                p.at("scratch_bytes").get<uint64_t>(),
                                {p.at("dispatches").get<uint64_t>(), p.at("host_waits").get<uint64_t>(),
                                 p.at("host_bytes").get<uint64_t>()},
                                p.value("clock", std::string())});
        }
        for (const Json& v : json.at("values")) {
            std::optional<uint32_t> frame;
            if (v.contains("frame")) frame = v.at("frame").get<uint32_t>();
            r.values.push_back(
                {v.at("pass").get<std::string>(), v.at("name").get<std::string>(), frame, v.at("value").get<double>()});
        }
        for (const Json& frame : json.at("frames"))
            r.frames.push_back({frame.at("frame").get<uint32_t>(), scoresFrom(frame.at("scores"))});
        VariantInputs inputs;
        for (const auto& [name, value] : json.at("inputs").items()) inputs.emplace_back(name, value.get<std::string>());
        return {r, inputs};
    } catch (const nlohmann::json::exception& error) {
        throw Error("broken result: {}", error.what());
    }
}

}  // namespace voxray
