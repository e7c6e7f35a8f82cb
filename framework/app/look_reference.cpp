#include "app/look_reference.h"

#include <charconv>
#include <chrono>

#include "app/session_requests.h"
#include "app/text_values.h"
#include "base/interrupt.h"

namespace voxray {
namespace {

using Clock = std::chrono::steady_clock;

/// Scores are told again when a reference has so many times the samples, since they cost as much as some of them.
constexpr double kGrowth = 1.1;

/// What scores and pictures of a page's answer depend on: of what, and with how many samples.
struct AnswerState {
    std::string subject;
    uint32_t samples;

    std::string text() const { return fmt::format("{} {}", subject, samples); }
    /// @param known the text of a state. @return whether it differs too little to be told again.
    bool isToldBy(const std::string& known, bool isWhole) const {
        if (!known.starts_with(subject + " ")) return false;
        uint32_t before = 0;
        std::from_chars(known.data() + subject.size() + 1, known.data() + known.size(), before);
        return samples == before || (!isWhole && samples < kGrowth * before);
    }
};

/// Adds scores to the answer. @return the picture that the request shows, or an empty one.
std::vector<uint8_t> addScores(Value& answer, ShownState& state, const ShownState::Rendering& rendering,
                               const std::string& show) {
    const Clock::time_point start = Clock::now();
    const ScoredFrame scored = state.score(rendering.images);
    answer.set("scores", scoresOf(scored.scores));
    answer.set("score_ms", numberValue(std::chrono::duration<double, std::milli>(Clock::now() - start).count()));
    const ImageSettings& settings = rendering.imageSettings;
    if (show == kShowError) return encodePng(scored.flip);
    if (show == kShowIndirectError && scored.indirectFlip) return encodePng(*scored.indirectFlip);
    if (show == kShowReference)
        return encodePng(preview(state.reference().images()->final.mean, settings.exposureStops, settings.tone));
    return {};
}

}  // namespace

Value metricsValue() {
    Value list = Value::list();
    for (const Metric& metric : metrics()) {
        Value value = Value::map();
        value.set("name", quotedText(metric.name));
        value.set("label", quotedText(metric.label));
        value.set("unit", quotedText(metric.unit));
        value.set("meaning", quotedText(metric.meaning));
        list.items.push_back(std::move(value));
    }
    return list;
}

std::string answerAboutReference(ShownState* state, const ShownImage& shown, const ImageRequest& request) {
    Value answer = Value::map();
    std::vector<uint8_t> png;
    try {
        if (state && state->hasReference()) {
            ProgressiveReference& reference = state->reference();
            if (reference.hasFailed()) state->advanceReference({});  // Which tells why
            const AnswerState now{fmt::format("{} {} {}", reference.hash(), shown.number, request.show),
                                  reference.samples()};
            const bool isTold = now.isToldBy(request.known, reference.isWhole());
            answer.set("state", quotedText(isTold ? request.known : now.text()));
            describe(answer, reference);
            if (!isTold && shown.rendering && reference.images())
                png = addScores(answer, *state, *shown.rendering, request.show);
        }
    } catch (const std::exception& error) {
        if (interruptRequested()) throw Interrupted();
        answer.set("error", quotedText(error.what()));
    }
    return answer.json(-1) + "\n" + std::string(png.begin(), png.end());
}

}  // namespace voxray
