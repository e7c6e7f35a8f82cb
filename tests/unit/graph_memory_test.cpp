// Graphs sum up what passes plan, and hold them to the limit when they take more.
#include <gtest/gtest.h>

#include "config/yaml.h"
#include "graph/graph.h"
#include "tests/support/on_device.h"

namespace voxray {
namespace {

constexpr uint64_t kKiB = 1024;

struct Nothing : Resource {};

/// Describes a kept and a scratch buffer, and makes others itself.
struct Hoard final : Pass {
    static constexpr const char* kName = "hoard";
    static constexpr const char* kHelp = "Takes memory.";
    struct Params {
        uint32_t described = 256;
        uint32_t prepareKept = 0;
        uint32_t recordKept = 0;
        uint32_t recordScratch = 0;
        static constexpr auto schema() {
            return std::tuple{field("described", &Params::described, "KiB.", 1u, 1u << 20),
                              field("prepare_kept", &Params::prepareKept, "KiB.", 0u, 1u << 20),
                              field("record_kept", &Params::recordKept, "KiB.", 0u, 1u << 20),
                              field("record_scratch", &Params::recordScratch, "KiB.", 0u, 1u << 20)};
        }
    };
    explicit Hoard(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override {
        plan.buffer(described_, "described", params_.described * kKiB);
        plan.scratchBuffer(scratch_, "described scratch", 256 * kKiB);
        plan.estimate(2.0 * params_.recordKept * kKiB);
    }
    void prepare(PassSetup& setup) override {
        EXPECT_EQ(described_.bytes(), params_.described * kKiB);
        EXPECT_FALSE(scratch_);
        if (params_.prepareKept > 0) atPrepare_ = Buffer(setup.device, "kept", params_.prepareKept * kKiB);
    }
    void record(PassContext& context) override {
        EXPECT_EQ(scratch_.bytes(), 256 * kKiB);
        context.stream.fill(scratch_, 1);
        context.stream.upload(described_, std::vector<uint32_t>(64 * kKiB, 2));
        if (params_.recordKept > 0 && !atRecord_) atRecord_ = Buffer(context.device, "more", params_.recordKept * kKiB);
        if (params_.recordScratch > 0) Buffer(context.device, "sums", params_.recordScratch * kKiB);
    }

 private:
    const Params params_;
    InOptional<Nothing> before_{*this, "nothing", "nothing"};
    Out<Nothing> nothing_{*this, "nothing", "nothing"};
    Buffer described_, scratch_, atPrepare_, atRecord_;
};

class GraphMemory : public test::OnDevice {
 protected:
    /// Plans, prepares and runs a Hoard twice. @return what it has taken.
    PassMemory run(const std::string& parameters) { return run(parameters, device_.memoryLimitBytes()); }
    PassMemory run(const std::string& parameters, uint64_t limit) {
        Registry registry;
        registry.add<Hoard>();
        Graph graph(registry, parseYaml("[{pass: hoard, id: greedy, " + parameters + "}]", "g.yaml"));
        Frame frame;
        frame.scene = &state_;
        planned_ = graph.plan(frame, device_.info(), limit).at(0);
        graph.prepare(frame, device_, compiler_, stream_);
        const uint64_t before = device_.memoryUsedBytes();
        for (int i = 0; i < 2; ++i) graph.run(Phase::Build, frame, device_, stream_, *tracer_, scene_, 0, false);
        keptByRecording_ = device_.memoryUsedBytes() - before;
        return graph.memory().at(0);
    }
    std::string errorOf(const std::string& parameters, uint64_t limit) {
        try {
            run(parameters, limit);
        } catch (const Error& error) {
            stream_.discard();
            return error.what();
        }
        return "no error";
    }

    PassMemory planned_;
    uint64_t keptByRecording_ = 0;
};

TEST_F(GraphMemory, DescribedBuffersArePlannedMadeAndFreed) {
    const uint64_t before = device_.memoryUsedBytes();
    const PassMemory taken = run("described: 256");
    EXPECT_EQ(planned_.bytes, 256 * kKiB);
    EXPECT_EQ(planned_.scratchBytes, 256 * kKiB);
    EXPECT_EQ(taken.bytes, 256 * kKiB);
    EXPECT_EQ(taken.scratchBytes, 512 * kKiB);  // With what the stream stages for the upload.
    EXPECT_EQ(keptByRecording_, 0u);
    EXPECT_EQ(device_.memoryUsedBytes(), before);  // The graph is gone.
    EXPECT_TRUE(device_.validationMessages().empty());
}

TEST_F(GraphMemory, WhatPassesMakeThemselvesIsMeasured) {
    const PassMemory taken = run("prepare_kept: 1024, record_kept: 2048, record_scratch: 1024");
    EXPECT_EQ(taken.bytes, (256 + 3072) * kKiB);
    EXPECT_EQ(taken.scratchBytes, (512 + 1024) * kKiB);
    EXPECT_EQ(keptByRecording_, 2048 * kKiB);
    EXPECT_EQ(planned_.bytes, 256 * kKiB);
    EXPECT_EQ(planned_.estimatedBytes, 4096 * kKiB);
}

TEST_F(GraphMemory, TheLimitHoldsForWhatIsCounted) {
    // What is described, and what is staged for an upload of 256 KiB.
    const uint64_t known = 3 * 256 * kKiB, limit = known + 1024 * kKiB;
    const uint64_t before = device_.memoryLimitBytes();
    EXPECT_EQ(run("record_kept: 1000", limit).bytes, (256 + 1000) * kKiB);
    for (const char* parameter : {"prepare_kept: 2048", "record_kept: 2048", "record_scratch: 2048"}) {
        const std::string error = errorOf(parameter, limit);
        EXPECT_EQ(error.find("g.yaml:1: greedy: '"), 0u) << error;
        EXPECT_NE(error.find("needs 2.0 MiB of device memory"), std::string::npos) << error;
        EXPECT_NE(error.find("lower what it grows with, of greedy."), std::string::npos) << error;
    }
    EXPECT_EQ(device_.memoryLimitBytes(), before);
}

TEST_F(GraphMemory, WhatIsTooLargeNamesThePassAndWhatToLower) {
    Registry registry;
    registry.add<Hoard>();
    const std::string advice =
        "lower what it grows with, of greedy.described, greedy.prepare_kept, first.described, first.record_kept, "
        "image.width, image.height";
    Graph graph(registry, parseYaml("- {pass: hoard, id: unread}\n"
                                    "- {pass: hoard, id: first, record_kept: 1}\n"
                                    "- {pass: hoard, id: greedy, described: 8192, prepare_kept: 8192}\n",
                                    "g.yaml"));
    Frame frame;
    frame.scene = &state_;
    const auto messageOf = [](const auto& work) -> std::string {
        try {
            work();
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    const std::string planned = messageOf([&] { graph.plan(frame, device_.info(), 4096 * kKiB); });
    EXPECT_EQ(planned.find("g.yaml:3: the graph needs "), 0u) << planned;
    EXPECT_NE(planned.find("the largest part is greedy's described with 8.0 MiB: " + advice), std::string::npos)
        << planned;

    const uint64_t limit = device_.memoryLimitBytes();
    graph.plan(frame, device_.info(), limit);
    device_.setMemoryLimitBytes(device_.memoryUsedBytes() + 4096 * kKiB);
    const std::string made = messageOf([&] { graph.prepare(frame, device_, compiler_, stream_); });
    device_.setMemoryLimitBytes(limit);
    EXPECT_EQ(made.find("g.yaml:3: greedy: 'described' needs 8.0 MiB"), 0u) << made;
    EXPECT_NE(made.find(": " + advice), std::string::npos) << made;
    stream_.discard();
}

}  // namespace
}  // namespace voxray
