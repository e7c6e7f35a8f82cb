#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/scoring.h"
#include "experiment/session.h"

namespace voxray {

class InteractiveSession;

/// What a session shows: a config without sweep whose values are changed one after another. A render builds again only
/// what they touch: build passes stay on the device while neither their parameters nor what they read changes. Images
/// are those of `run` with the same values.
class ShownState {
 public:
    /// @param session must outlive the state. @throws UsageError as makeStudy() and planVariants().
    ShownState(InteractiveSession& session, Value config);

    /// Takes a config, without sweep, in place of all values. @throws UsageError; the state is then as it was.
    void open(Value config);
    /// Takes the values of a variant, by its id. @throws UsageError, as open().
    void select(const std::string& id);
    /// Sets the value at a path of the config (config/overrides.h); null removes it.
    /// @throws UsageError as a run would; the state is then as it was.
    void set(const std::string& path, const Value& value);

    /// The config with all values that were set.
    const Value& config() const { return study_.experiment.config; }
    /// Warnings of the current values and of scenes.
    std::vector<std::string> warnings() const;

    struct Rendering {
        FrameImages images;
        ImageSettings imageSettings;
        CameraSettings camera;            ///< In the config's coordinates; its target is 1 m away.
        float sceneSize;                  ///< Diagonal of the scene's bounds, m.
        Measurement measurement;          ///< Of reused passes: that of their last run.
        std::vector<std::string> reused;  ///< Ids of the passes that did not run again.
    };
    /// Renders the compared frame. Warm-up frames of the config are rendered if a pass has temporal history.
    /// @param progress is called with the fraction done. @throws Error, Interrupted.
    Rendering render(const std::function<void(double)>& progress);

    struct Change {
        std::string path;
        Value value;
    };
    /// Renders the config with changes that are not kept, as a first look: without warm-up frames and without the
    /// checks of scene and view. @param shrink width and height are divided by it.
    /// @throws UsageError for what is wrong by itself, Error, Interrupted.
    Rendering draft(const std::vector<Change>& changes, uint32_t shrink, const std::function<void(double)>& progress);

    /// Scores images of the current values against the reference, which is rendered if it isn't cached.
    /// @throws UsageError if the config has no reference, Error, Interrupted.
    ScoredFrame score(const FrameImages& rendered, const std::function<void(double)>& progress);

 private:
    /// The config with a change. @throws UsageError
    static void apply(Value& config, const Change& change);
    /// Renders a graph that has not run.
    Rendering render(Graph graph, const Setup& setup, const MeasureSettings& measure,
                     const std::function<void(double)>& progress);
    const Variant& variant() const { return study_.variants.front(); }

    InteractiveSession& session_;
    Session& resources_;
    Study study_;  ///< Of one variant.

    // Of the last rendering
    std::optional<Graph> graph_;
    std::string builtFor_;  ///< What build passes depend on besides the graph: scene, tracer, seed.
    std::string viewOf_;    ///< Camera and image size.
    std::optional<PreparedReference> reference_;
    std::string preparedFor_;  ///< What the prepared reference depends on.
};

}  // namespace voxray
