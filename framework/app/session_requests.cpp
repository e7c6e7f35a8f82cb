#include "app/session_requests.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "app/text_values.h"
#include "app/view_requests.h"
#include "experiment/view_files.h"

namespace voxray {
namespace {

void allow(const Value& request, const std::vector<std::string>& keys) {
    for (const auto& [key, value] : request.members)
        if (key != "id" && key != "command" && std::ranges::count(keys, key) == 0)
            throw UsageError(value.where, "{}: unknown key '{}'", textOf(request, "command"), key);
}

}  // namespace

std::string textOf(const Value& request, const std::string& key) {
    const Value* value = request.find(key);
    if (!value) throw UsageError(request.where, "the request has no '{}'", key);
    return value->asString(key);
}

Value greetingOf(InteractiveSession& session) {
    Value answer = Value::map(), variants = Value::list();
    answer.set("voxray", quotedText(VOXRAY_VERSION));
    answer.set("protocol", numberValue(kSessionProtocol));
    for (const auto& [name, id] : session.variants()) {
        Value variant = Value::map();
        variant.set("id", quotedText(id));
        variant.set("name", quotedText(name));
        variants.items.push_back(std::move(variant));
    }
    answer.set("variants", std::move(variants));
    answer.set("warnings", listOf(session.side(0).warnings()));
    return answer;
}

void describe(Value& answer, const ShownState::Rendering& rendering) {
    const Measurement& m = rendering.measurement;
    Value passes = Value::list(), values = Value::list();
    for (const PassCost& cost : m.passes) {
        Value pass = Value::map();
        pass.set("id", quotedText(cost.id));
        pass.set("phase", quotedText(cost.phase == Phase::Build ? "build" : "frame"));
        pass.set("ms", numberValue(cost.milliseconds.median));
        pass.set("rays", numberValue(cost.rays));
        pass.set("memory_bytes", numberValue(cost.memoryBytes));
        pass.set("reused", flag(std::ranges::count(rendering.reused, cost.id) > 0));
        passes.items.push_back(std::move(pass));
    }
    for (const ReportedValue& reported : m.values) {
        Value value = Value::map();
        value.set("pass", quotedText(reported.pass));
        value.set("name", quotedText(reported.name));
        value.set("value", numberValue(reported.value));
        values.items.push_back(std::move(value));
    }
    answer.set("width", numberValue(rendering.imageSettings.width));
    answer.set("height", numberValue(rendering.imageSettings.height));
    answer.set("frame_ms", numberValue(m.frameMs.median));
    answer.set("memory_bytes", numberValue(m.memoryBytes));
    answer.set("passes", std::move(passes));
    answer.set("values", std::move(values));
}

void describe(Value& answer, ProgressiveReference& reference) {
    answer.set("samples", numberValue(reference.samples()));
    answer.set("of", numberValue(reference.of()));
    answer.set("noise", scoresOf(reference.noise()));
}

Value scoresOf(const Scores& scores) {
    Value all = Value::map();
    for (const auto& [column, value] : scores) all.set(column, numberValue(value));
    return all;
}

Value RequestHandler::answer(const Value& request) {
    const std::string command = textOf(request, "command");
    Value answer = Value::map();
    if (command == "set") {
        set(request, answer);
    } else if (command == "select") {
        select(request, answer);
    } else if (command == "config") {
        allow(request, {});
        answer.set("config", state_.config());
    } else if (command == "render") {
        allow(request, {});
        render(answer);
    } else if (command == "reference") {
        allow(request, {"ms"});
        reference(request, answer);
    } else if (command == "score") {
        allow(request, {});
        score(answer);
    } else if (command == "views") {
        allow(request, {});
        renderChanges();
        answer.set("views", listViews(state_));
    } else if (command == "view") {
        allow(request, {"name", "parameters", "picture"});
        const Value* picture = request.find("picture");
        renderChanges();
        answer = writeView(
            state_,
            viewChoice(textOf(request, "name"), request.find("parameters"), std::numeric_limits<uint64_t>::max()),
            picture && picture->asBool("picture"), images_.folder);
    } else {
        throw UsageError(request.where,
                         "no command '{}'; there are config, reference, render, score, select, set, "
                         "view, views",
                         command);
    }
    return answer;
}

void RequestHandler::set(const Value& request, Value& answer) {
    allow(request, {"path", "value"});
    const Value* value = request.find("value");
    if (!value) throw UsageError(request.where, "set: it has no 'value'; null takes the config's entry out");
    const std::string path = textOf(request, "path");
    state_.set(path, *value);
    rendering_.reset();
    std::erase_if(set_, [&](const ShownState::Change& change) { return change.path == path; });
    set_.push_back({path, *value});
    answer.set("warnings", listOf(state_.warnings()));
}

void RequestHandler::select(const Value& request, Value& answer) {
    allow(request, {"variant", "keep"});
    const Value* keep = request.find("keep");
    const bool keeps = keep && keep->asBool("keep");
    // A whole graph would take the variant's place
    const auto isKept = [&](const ShownState::Change& change) { return keeps && change.path != "graph"; };
    std::vector<ShownState::Change> kept;
    std::vector<std::string> dropped;
    for (const ShownState::Change& change : set_)
        if (isKept(change))
            kept.push_back(change);
        else
            dropped.push_back(change.path);
    state_.select(textOf(request, "variant"), kept);
    set_ = std::move(kept);
    rendering_.reset();
    answer.set("dropped", listOf(dropped));
    answer.set("warnings", listOf(state_.warnings()));
}

Value RequestHandler::write(const std::string& name, const ImageF& image) const {
    const std::filesystem::path file = images_.folder / (name + (images_.isNpy ? ".npy" : ".exr"));
    if (images_.isNpy)
        writeNpy(file, viewOfImage({}, image, {}));
    else
        writePlainExr(file, image);
    return quotedText(file.string());
}

void RequestHandler::renderChanges() {
    if (!rendering_) rendering_ = state_.render([](double) {});
}

void RequestHandler::render(Value& answer) {
    rendering_.reset();
    renderChanges();
    Value files = Value::map();
    files.set(kComparedImage, write(kComparedImage, rendering_->images.final));
    if (rendering_->images.indirect) files.set(kIndirectImage, write(kIndirectImage, *rendering_->images.indirect));
    answer.set("images", std::move(files));
    describe(answer, *rendering_);
}

void RequestHandler::reference(const Value& request, Value& answer) {
    std::optional<std::chrono::milliseconds> budget;
    if (const Value* given = request.find("ms")) {
        const int64_t milliseconds = given->asInteger("ms");
        if (milliseconds < 0) throw UsageError(given->where, "reference: ms is 0 or more");
        budget = std::chrono::milliseconds(milliseconds);
    }
    const bool isLookedAtAlone = budget && budget->count() == 0;
    ProgressiveReference& reference = isLookedAtAlone ? state_.reference() : state_.advanceReference(budget);
    Value files = Value::map();
    if (const ReferenceImages* images = reference.images()) {
        files.set(kComparedImage, write("reference_final", images->final.mean));
        files.set(kIndirectImage, write("reference_indirect", images->indirect.mean));
    }
    answer.set("images", std::move(files));
    describe(answer, reference);
}

void RequestHandler::score(Value& answer) {
    renderChanges();
    const ScoredFrame scored = state_.score(rendering_->images);
    Value files = Value::map();
    files.set(kComparedImage, write("flip", scored.flip));
    if (scored.indirectFlip) files.set(kIndirectImage, write("indirect_flip", *scored.indirectFlip));
    answer.set("images", std::move(files));
    answer.set("scores", scoresOf(scored.scores));
    describe(answer, state_.reference());
}

}  // namespace voxray
