#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/progressive_reference.h"
#include "experiment/scoring.h"
#include "experiment/session.h"
#include "experiment/view_picture.h"

namespace voxray {

class InteractiveSession;

/// The pass that draws voxels, and the view that it is.
inline constexpr const char* kShowVoxels = "show_voxels";

/// A view to look at, by its name.
struct ViewChoice {
    std::string name;    ///< "<pass>.<what>" of ShownState::views(), or kShowVoxels.
    Value parameters;    ///< Of kShowVoxels, with the entry `inputs`; a map.
    uint64_t maxValues;  ///< Of a buffer; its first ones are read.
};

/// What a session shows: a config without sweep whose values are changed one after another. A render builds again only
/// what they touch: build passes stay on the device while neither their parameters nor what they read changes. Images
/// are those of `run` with the same values.
class ShownState {
 public:
    /// @param session must outlive the state. @param variant the id of the variant whose values these are, or "".
    /// @throws UsageError as makeStudy() and planVariants().
    ShownState(InteractiveSession& session, Value config, std::string variant);

    /// Takes a config, without sweep, in place of all values. @throws UsageError; the state is then as it was.
    void open(Value config);
    struct Change {
        std::string path;
        Value value;
    };
    /// Takes the values of a variant, by its id or its name, with changes to them. @throws UsageError, as open().
    void select(const std::string& variant, const std::vector<Change>& changes = {});
    /// Sets the value at a path of the config (config/overrides.h); null removes it.
    /// @throws UsageError as a run would; the state is then as it was.
    void set(const std::string& path, const Value& value);

    /// The config with all values that were set.
    const Value& config() const { return study_.experiment.config; }
    /// Ids of passes on which the image does not depend.
    const std::vector<std::string>& culledPasses() const { return variant().culledPasses; }
    /// Id of the variant whose values were taken last; "" after open().
    const std::string& variantId() const { return variantId_; }
    /// Whether the values differ from those of variantId() in more than camera and image.
    bool isChanged() const;
    /// Warnings of the current values, of the last one that was set, and of scenes.
    std::vector<std::string> warnings() const;

    struct Rendering {
        FrameImages images;             ///< None if a view is shown.
        std::optional<ViewArray> view;  ///< The view that is shown.
        ImageSettings imageSettings;
        CameraSettings camera;            ///< In the config's coordinates; its target is 1 m away.
        float sceneSize;                  ///< Diagonal of the scene's bounds, m.
        Measurement measurement;          ///< Of reused passes: that of their last run.
        std::vector<std::string> reused;  ///< Ids of the passes that did not run again.
    };
    /// Renders the compared frame. Warm-up frames of the config are rendered if a pass has temporal history.
    /// @param progress is called with the fraction done. @param shown in place of the images, if it is not null: frame
    /// passes that this view does not need are skipped. @throws UsageError for a view that is not there, Error,
    /// Interrupted.
    Rendering render(const std::function<void(double)>& progress, const ViewChoice* shown = nullptr);

    /// Renders the config with changes that are not kept, as a first look: without warm-up frames and without the
    /// checks of scene and view. @param shrink width and height are divided by it.
    /// @throws UsageError for what is wrong by itself, Error, Interrupted.
    Rendering draft(const std::vector<Change>& changes, uint32_t shrink, const std::function<void(double)>& progress,
                    const ViewChoice* shown = nullptr);

    /// All that can be looked at of the last rendering, but voxels. Reads nothing back.
    /// @throws UsageError if there is no last rendering, or it failed.
    std::vector<ViewInfo> views() const;
    /// Values of the parameter `show` of kShowVoxels that it can draw of the last rendering; empty: none.
    /// @throws UsageError, as views().
    std::vector<std::string> voxelsToShow();
    /// Reads a view of the last rendering, or draws voxels on what it left. @throws UsageError, as views() and for a
    /// view or parameter that is not there; Error.
    ViewArray view(const ViewChoice& choice);
    /// Of the last rendering. @throws UsageError, as views().
    const ImageSettings& renderedImage() const;

    bool hasReference() const { return !study_.reference.isNull(); }
    /// Variant::referenceHash of the current values.
    const std::string& referenceHash() const { return variant().referenceHash; }
    /// The reference of the current values, with the samples that it has. @throws UsageError if the config has none.
    ProgressiveReference& reference();
    /// Renders more of it (ProgressiveReference::advance()). @throws also UsageError if the config has none.
    ProgressiveReference& advanceReference(std::optional<std::chrono::milliseconds> budget);
    /// Scores images of the current values against all samples of the reference so far; one without images is
    /// rendered to its end first. Scores without an interval have their noise floor, too (kNoise).
    /// @throws UsageError if the config has no reference, Error, Interrupted.
    ScoredFrame score(const FrameImages& rendered);

 private:
    void take(Study study);
    /// The config with a change. @throws UsageError
    static void apply(Value& config, const Change& change);
    /// A rendering whose graph and frame are kept for views.
    struct Rendered {
        Setup setup;
        Frame frame;
    };

    /// Renders a graph that has not run.
    Rendering render(Graph graph, const Setup& setup, const MeasureSettings& measure,
                     const std::function<void(double)>& progress, const ViewChoice* shown);
    const Variant& variant() const { return study_.variants.front(); }
    /// Skips frame passes that a view does not need; appends the pass that draws it, if any. @throws UsageError
    void runOnlyFor(Graph& graph, const ViewChoice& choice) const;
    ViewArray readShown(const Graph& graph, const Frame& frame, const glm::vec3& origin,
                        const ViewChoice& choice) const;
    const Rendered& requireRendered() const;

    InteractiveSession& session_;
    Session& resources_;
    Study study_;  ///< Of one variant.
    std::string variantId_;

    // Of the last rendering
    std::optional<Graph> graph_;
    bool isReusable_ = false;           ///< Whether another graph may reuse it.
    std::optional<Rendered> rendered_;  ///< Unless it failed.
    std::string builtFor_;              ///< What build passes depend on besides the graph: scene, tracer, seed.
    std::string viewOf_;                ///< Camera and image size.
    std::optional<PreparedReference> prepared_;
    std::string preparedFor_;  ///< What the prepared reference depends on.
};

}  // namespace voxray
