// What can be looked at of a graph's passes, and a pass that is run after all others.
#include <gtest/gtest.h>

#include "config/yaml.h"
#include "graph/graph.h"
#include "tests/support/errors.h"
#include "tests/support/on_device.h"

namespace voxray {
namespace {

struct Words : Resource {
    Buffer words;
    std::vector<Elements> elements() const override { return {{&words, Elements::Type::Float32, 3}}; }
};

struct Layers : Resource {
    Image image;
    std::vector<Aov> aovs() const override { return {{&image, {"N.X", "N.Y", "depth"}, Quantity::Direction}}; }
};

/// Makes buffers in the build phase, one of them as it runs.
struct Build final : Pass {
    static constexpr const char* kName = "build";
    static constexpr const char* kHelp = "Makes buffers.";
    void plan(PassPlan& plan) override {
        plan.buffer(list_, "list", 8);
        plan.scratchBuffer(scratch_, "scratch", 8);
    }
    void record(PassContext& context) override {
        ++runs;
        Buffer words(context.device, "words", 24);
        const Buffer gone(context.device, "gone", 4);
        context[words_].words = std::move(words);
        more_.clear();
        for (int i = 0; i < 2; ++i) more_.emplace_back(context.device, "more", 4u);
    }
    static inline int runs = 0;
    Out<Words> words_{*this, "words", "words"};
    Buffer list_, scratch_;
    std::vector<Buffer> more_;
};

/// Writes images in each frame.
struct Draw final : Pass {
    static constexpr const char* kName = "draw";
    static constexpr const char* kHelp = "Writes images.";
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override {
        plan.frameImage(final_);
        plan.image(plan[layers_].image, "layers", frameImageDesc(plan.frame));
        plan.image(history_, "history", frameImageDesc(plan.frame));
    }
    void record(PassContext& context) override {
        ++runs;
        context.stream.clear(context[final_].image, {{1, 2, 3, 4}});
    }
    static inline int runs = 0;
    In<Words> words_{*this, "words", "words"};
    Out<FrameImage> final_{*this, "final", "an image"};
    Out<Layers> layers_{*this, "layers", "more images"};
    Image history_;
};

/// Copies an image.
struct Copy final : Pass {
    static constexpr const char* kName = "copy";
    static constexpr const char* kHelp = "Copies an image.";
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override { plan.frameImage(final_); }
    void record(PassContext& context) override {
        ++runs;
        context.report("width", context[before_].image.desc().extent.x);
    }
    static inline int runs = 0;
    In<FrameImage> before_{*this, "final", "an image"};
    Out<FrameImage> final_{*this, "final", "the same"};
};

/// Reads what no other pass does.
struct ReadLayers final : Pass {
    static constexpr const char* kName = "read_layers";
    static constexpr const char* kHelp = "Reads layers.";
    void plan(PassPlan&) override {}
    void record(PassContext&) override {}
    In<Layers> layers_{*this, "layers", "images"};
};

class GraphViews : public test::OnDevice {
 protected:
    GraphViews() {
        registry_.add<Build>();
        registry_.add<Draw>();
        registry_.add<Copy>();
        registry_.add<ReadLayers>();
        frame_.scene = &state_;
        frame_.width = frame_.height = 2;
        graph_ = std::make_unique<Graph>(registry_, parseYaml("[{pass: build}, {pass: draw}, {pass: copy}]", "g.yaml"));
        graph_->cullUnused({"final"});
        Build::runs = Draw::runs = Copy::runs = 0;
    }
    void prepare() {
        graph_->plan(frame_, device_.info(), device_.memoryLimitBytes());
        graph_->prepare(frame_, device_, compiler_, stream_);
    }
    std::vector<PassSample> run(Phase phase) {
        return graph_->run(phase, frame_, device_, stream_, *tracer_, scene_, 0, false);
    }
    /// Names of views as "pass.name".
    std::string names() {
        std::string text;
        for (const Graph::View& view : graph_->views(device_)) text += view.pass + "." + view.name + " ";
        return text;
    }

    Registry registry_;
    Frame frame_;
    std::unique_ptr<Graph> graph_;
};

TEST_F(GraphViews, AreWhatPassesHaveInMemory) {
    EXPECT_EQ(names(), "");
    prepare();
    EXPECT_EQ(names(), "build.list draw.N draw.depth draw.final draw.history copy.final ");
    run(Phase::Build);
    run(Phase::Frame);
    EXPECT_EQ(names(),
              "build.list build.words build.more build.more 2 draw.N draw.depth draw.final draw.history copy.final ");
    run(Phase::Build);  // What was made anew takes the place of the old
    EXPECT_EQ(graph_->views(device_).size(), 9u);

    const std::vector<Graph::View> views = graph_->views(device_);
    const Graph::View &words = views.at(1), &normal = views.at(4), &depth = views.at(5), &final = views.at(6);
    EXPECT_EQ(words.elements.buffer, &graph_->resource<Words>("words")->words);
    EXPECT_EQ(words.elements.type, Elements::Type::Float32);
    EXPECT_EQ(words.elements.components, 3u);
    EXPECT_EQ(normal.channels, (std::vector<std::string>{"N.X", "N.Y"}));
    EXPECT_EQ(normal.quantity, Quantity::Direction);
    EXPECT_EQ(depth.firstChannel, 2u);
    EXPECT_EQ(depth.image, normal.image);
    EXPECT_EQ(final.quantity, Quantity::Radiance);
    EXPECT_TRUE(normal.isAov && !final.isAov);
}

TEST_F(GraphViews, AreThoseOfReusedPasses) {
    prepare();
    run(Phase::Build);
    Graph next(registry_, parseYaml("[{pass: build}, {pass: draw}]", "g.yaml"));
    next.cullUnused({"final"});
    next.reuse(*graph_, true);
    *graph_ = std::move(next);
    EXPECT_EQ(names(), "build.list build.words build.more build.more 2 ");
}

TEST_F(GraphViews, FramePassesThatAViewDoesNotNeedAreSkipped) {
    graph_->runOnlyFor("draw");
    prepare();
    run(Phase::Build);
    EXPECT_EQ(run(Phase::Frame).size(), 2u);
    EXPECT_EQ(Draw::runs, 1);
    EXPECT_EQ(Copy::runs, 0);
    graph_->runOnlyFor("build");
    run(Phase::Build);
    run(Phase::Frame);
    EXPECT_EQ(Build::runs, 2);
    EXPECT_EQ(Draw::runs, 1);
    EXPECT_TRUE(graph_->passes().at(1).isSkipped && !graph_->passes().at(0).isSkipped);
}

TEST_F(GraphViews, AnAppendedPassRunsAloneOnWhatTheOthersWrote) {
    prepare();
    run(Phase::Build);
    run(Phase::Frame);
    graph_->keepAll();
    graph_->append(registry_, parseYaml("{pass: copy, id: last}", "g.yaml"));
    prepare();
    const std::vector<PassSample> samples = run(Phase::Frame);
    EXPECT_EQ(samples.at(2).reported.at(0).value, 2);
    EXPECT_EQ(Build::runs, 1);
    EXPECT_EQ(Draw::runs, 1);
    EXPECT_EQ(Copy::runs, 2);
    EXPECT_NE(graph_->image("final"), nullptr);
    graph_->dropLast();
    EXPECT_EQ(graph_->passes().size(), 3u);

    // Nothing reads the layers, so that their writer might leave them empty
    const auto append = [&](const char* entry) {
        return errorOf([&] { graph_->append(registry_, parseYaml(entry, "g.yaml")); });
    };
    EXPECT_TRUE(contains(append("{pass: read_layers}"), "no pass of the config reads it"));
    EXPECT_TRUE(contains(append("{pass: copy}"), "there is a pass 'copy' already"));
    EXPECT_TRUE(contains(append("{pass: copy, id: x, inputs: {final: nobody}}"), "no pass has the id 'nobody'"));
    EXPECT_EQ(graph_->passes().size(), 3u);
}

}  // namespace
}  // namespace voxray
