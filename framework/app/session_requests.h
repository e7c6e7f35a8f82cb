#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/value.h"
#include "experiment/interactive_session.h"

/// Requests and answers of docs/session.md.
namespace voxray {

inline constexpr int kSessionProtocol = 1;

/// What a client is told first.
Value greetingOf(InteractiveSession& session);

/// Size, times, memory, passes and values of a rendering, without its images.
void describe(Value& answer, const ShownState::Rendering& rendering);

/// Samples and noise of a reference, without its images.
void describe(Value& answer, ProgressiveReference& reference);

/// Scores by column.
Value scoresOf(const Scores& scores);

/// The entry `key` of a request. @throws UsageError if it is missing or no text.
std::string textOf(const Value& request, const std::string& key);

/// Where `voxray session` leaves images, and how.
struct ImageFolder {
    std::filesystem::path folder;
    bool isNpy = false;  ///< NumPy's format, else EXR.
};

/// Answers requests of `voxray session`.
class RequestHandler {
 public:
    RequestHandler(ShownState& state, ImageFolder images) : state_(state), images_(std::move(images)) {}

    /// @throws UsageError, Error, Interrupted.
    Value answer(const Value& request);

 private:
    void set(const Value& request, Value& answer);
    void select(const Value& request, Value& answer);
    void render(Value& answer);
    /// Renders if anything was changed since the last rendering, so that scores and views are of the current values.
    void renderChanges();
    void reference(const Value& request, Value& answer);
    void score(Value& answer);
    /// Writes an image to a file of that name. @return the file.
    Value write(const std::string& name, const ImageF& image) const;

    ShownState& state_;
    const ImageFolder images_;
    std::optional<ShownState::Rendering> rendering_;  ///< Of the current values.
    std::vector<ShownState::Change> set_;             ///< What was set since a variant was selected, the latest last.
};

}  // namespace voxray
