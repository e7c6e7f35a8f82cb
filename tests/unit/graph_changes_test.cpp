// What passes are told of changes of their inputs.
#include <gtest/gtest.h>

#include "config/yaml.h"
#include "graph/graph.h"
#include "tests/support/on_device.h"

namespace voxray {
namespace {

struct Number : Resource {
    uint32_t value = 0;
};

/// Writes the scene's version; keeps what it has where the scene has not changed.
struct Write final : Pass {
    static constexpr const char* kName = "write";
    static constexpr const char* kHelp = "Writes a number.";
    void plan(PassPlan&) override {}
    void record(PassContext& context) override {
        if (!context.isFirstRun() && context[number_].value == context.frame.sceneVersion)
            return context.markOutputsUnchanged();
        context[number_].value = uint32_t(context.frame.sceneVersion);
    }
    Out<Number> number_{*this, "number", "a number"};
};

/// Writes twice the number where that is another one.
struct Double final : Pass {
    static constexpr const char* kName = "double";
    static constexpr const char* kHelp = "Doubles a number.";
    void plan(PassPlan&) override {}
    void record(PassContext& context) override {
        if (!context.inputsChanged()) return;
        context[twice_].value = 2 * context[number_].value;
        context.report("runs", ++runs_);
    }
    In<Number> number_{*this, "number", "a number"};
    Out<Number> twice_{*this, "twice", "its double"};
    uint32_t runs_ = 0;
};

/// Reports which of its inputs have changed.
struct Watch final : Pass {
    static constexpr const char* kName = "watch";
    static constexpr const char* kHelp = "Watches numbers.";
    void plan(PassPlan&) override {}
    void record(PassContext& context) override {
        context.report("first run", context.isFirstRun());
        context.report("number", context.changed(number_));
        context.report("twice", context.changed(context[twice_]));
        context.report("absent", context.changed(absent_));
    }
    In<Number> number_{*this, "number", "a number"};
    In<Number> twice_{*this, "twice", "its double"};
    InOptional<Number> absent_{*this, "absent", "nothing"};
};

/// Asks whether its own output changed.
struct AskForOutput final : Pass {
    static constexpr const char* kName = "ask_for_output";
    static constexpr const char* kHelp = "Asks for what is no input.";
    void plan(PassPlan&) override {}
    void record(PassContext& context) override { context.changed(context[number_]); }
    Out<Number> number_{*this, "number", "a number"};
};

/// Writes the image's width, in the build phase. Fails where it is odd.
struct WriteWidth final : Pass {
    static constexpr const char* kName = "write_width";
    static constexpr const char* kHelp = "Writes the image's width.";
    bool buildReadsView() const override { return true; }
    void plan(PassPlan&) override {}
    void record(PassContext& context) override {
        context[width_].value = context.frame.width;
        if (context.frame.width % 2 == 1) throw Error("odd");
    }
    Out<Number> width_{*this, "width", "a number"};
};

class GraphChanges : public test::OnDevice {
 protected:
    GraphChanges() {
        registry_.add<Write>();
        registry_.add<Double>();
        registry_.add<Watch>();
        registry_.add<AskForOutput>();
        registry_.add<WriteWidth>();
        frame_.scene = &state_;
        make("[{pass: write}, {pass: double}, {pass: watch}]");
    }
    void make(const std::string& graph) {
        graph_ = std::make_unique<Graph>(registry_, parseYaml(graph, "g.yaml"));
        graph_->plan(frame_, device_.info(), device_.memoryLimitBytes());
        graph_->prepare(frame_, device_, compiler_, stream_);
    }
    void runBuild() { samples_ = graph_->run(Phase::Build, frame_, device_, stream_, *tracer_, scene_, 0, false); }
    /// Makes and builds a graph that reuses the last one. @return ids of reused passes
    std::string next(const std::string& graph, bool sameView = true) {
        stream_.discard();  // What a failed one recorded
        const std::unique_ptr<Graph> previous = std::move(graph_);
        graph_ = std::make_unique<Graph>(registry_, parseYaml(graph, "g.yaml"));
        graph_->reuse(*previous, sameView);
        graph_->plan(frame_, device_.info(), device_.memoryLimitBytes());
        graph_->prepare(frame_, device_, compiler_, stream_);
        runBuild();
        std::string reused;
        for (const Graph::PassInfo& pass : graph_->passes())
            if (pass.isReused) reused += pass.id + " ";
        return reused;
    }
    /// What Watch reports of a run, as "first run number twice absent".
    std::string run() {
        runBuild();
        std::string text;
        for (const PassContext::Value& value : samples_.at(2).reported) text += value.value != 0 ? '1' : '0';
        return text;
    }

    Registry registry_;
    Frame frame_;
    std::unique_ptr<Graph> graph_;
    std::vector<PassSample> samples_;
};

TEST_F(GraphChanges, AreToldOncePerReader) {
    EXPECT_EQ(run(), "1110");
    EXPECT_EQ(run(), "0000");
    ++frame_.sceneVersion;
    EXPECT_EQ(run(), "0110");
    EXPECT_EQ(run(), "0000");
}

TEST_F(GraphChanges, WhoSeesNoneLeavesItsOutputs) {
    run();
    EXPECT_EQ(samples_.at(1).reported.size(), 1u);
    run();
    EXPECT_EQ(samples_.at(1).reported.size(), 0u);
    frame_.sceneVersion += 3;
    run();
    EXPECT_EQ(samples_.at(1).reported.at(0).value, 2);
    EXPECT_EQ(graph_->resource<Number>("twice")->value, 6u);
}

TEST_F(GraphChanges, OutputsOfAnotherGraphAreReusedWhereNothingChanged) {
    const char* whole = "[{pass: write}, {pass: double}, {pass: watch}]";
    frame_.sceneVersion = 3;
    runBuild();
    EXPECT_EQ(next(whole), "write double watch ");
    EXPECT_EQ(samples_.at(1).reported.at(0).value, 1);  // That of the only run.
    EXPECT_EQ(graph_->resource<Number>("twice")->value, 6u);

    EXPECT_EQ(next("[{pass: write}, {pass: double}]"), "write double ");
    EXPECT_EQ(graph_->resource<Number>("twice")->value, 6u);

    // Another pass, and one that reads it; then one with other inputs
    EXPECT_EQ(next("[{pass: write, id: other}, {pass: double}]"), "");
    EXPECT_EQ(next("[{pass: write, id: other}, {pass: write}, {pass: double, inputs: {number: other}}, "
                   "{pass: watch, inputs: {number: other}}]"),
              "other ");
}

TEST_F(GraphChanges, WhatReadsTheViewIsReusedInTheSameViewAlone) {
    const char* passes = "[{pass: write_width}, {pass: write}]";
    make(passes);
    frame_.width = 6;
    runBuild();
    EXPECT_EQ(next(passes, true), "write_width write ");
    frame_.width = 8;
    EXPECT_EQ(next(passes, false), "write ");
    EXPECT_EQ(graph_->resource<Number>("width")->value, 8u);
}

TEST_F(GraphChanges, NothingOfAPhaseThatFailedIsReused) {
    const char* passes = "[{pass: write}, {pass: write_width}]";
    make(passes);
    frame_.width = 7;
    EXPECT_THROW(runBuild(), Error);
    frame_.width = 8;
    EXPECT_EQ(next(passes, true), "");
    // What was reused before stays
    frame_.width = 9;
    EXPECT_THROW(next(passes, false), Error);
    frame_.width = 10;
    EXPECT_EQ(next(passes, true), "write ");
    EXPECT_EQ(graph_->resource<Number>("width")->value, 10u);
}

TEST_F(GraphChanges, AreToldOfInputsAlone) {
    make("[{pass: ask_for_output}]");
    EXPECT_THROW(runBuild(), Error);
    EXPECT_THROW(registry_.add<Write>(), Error);  // A name belongs to one pass.
}

}  // namespace
}  // namespace voxray
