// Graphs hold passes to the memory that they plan.
#include <gtest/gtest.h>

#include "config/yaml.h"
#include "graph/graph.h"
#include "scene/load.h"
#include "tests/support/places.h"

namespace voxray {
namespace {

constexpr uint64_t kKiB = 1024;

struct Nothing : Resource {};

/// Describes a kept and a scratch buffer of 256 KiB, and makes others itself.
struct Hoard final : Pass {
    static constexpr const char* kName = "hoard";
    static constexpr const char* kHelp = "Takes memory.";
    struct Params {
        uint32_t reserveKept = 0;
        uint32_t reserveCounted = 0;
        uint32_t reserveScratch = 0;
        uint32_t prepareKept = 0;
        uint32_t recordKept = 0;
        uint32_t recordScratch = 0;
        static constexpr auto schema() {
            return std::tuple{field("reserve_kept", &Params::reserveKept, "KiB.", 0u, 1u << 20),
                              field("reserve_counted", &Params::reserveCounted, "KiB.", 0u, 1u << 20),
                              field("reserve_scratch", &Params::reserveScratch, "KiB.", 0u, 1u << 20),
                              field("prepare_kept", &Params::prepareKept, "KiB.", 0u, 1u << 20),
                              field("record_kept", &Params::recordKept, "KiB.", 0u, 1u << 20),
                              field("record_scratch", &Params::recordScratch, "KiB.", 0u, 1u << 20)};
        }
    };
    explicit Hoard(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override {
        plan.buffer(described_, "described", 256 * kKiB);
        plan.scratchBuffer(scratch_, "described scratch", 256 * kKiB);
        plan.reserve("kept", params_.reserveKept * kKiB);
        if (params_.reserveCounted > 0) plan.reserveCounted("counted", params_.reserveCounted * kKiB);
        plan.reserveScratch("scratch", params_.reserveScratch * kKiB);
    }
    void prepare(PassSetup& setup) override {
        EXPECT_EQ(described_.bytes(), 256 * kKiB);
        EXPECT_FALSE(scratch_);
        if (params_.prepareKept > 0) atPrepare_ = Buffer(setup.device, "kept", params_.prepareKept * kKiB);
    }
    void record(PassContext& context) override {
        EXPECT_EQ(scratch_.bytes(), 256 * kKiB);
        context.report("spare", double(context.spareBytes));
        context.stream.fill(scratch_, 1);
        context.stream.upload(described_, std::vector<uint32_t>(64 * kKiB, 2));
        if (params_.recordKept > 0 && !atRecord_)
            atRecord_ = Buffer(context.device, "more", params_.recordKept * kKiB);
        if (params_.recordScratch > 0) Buffer(context.device, "sums", params_.recordScratch * kKiB);
    }

 private:
    const Params params_;
    InOptional<Nothing> before_{*this, "nothing", "nothing"};
    Out<Nothing> nothing_{*this, "nothing", "nothing"};
    Buffer described_, scratch_, atPrepare_, atRecord_;
};

class GraphMemory : public testing::Test {
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
        spare_.clear();
        graph.prepare(frame, device_, compiler_, stream_);
        const uint64_t before = device_.memoryUsedBytes();
        for (int i = 0; i < 2; ++i)
            for (const PassSample& sample :
                 graph.run(Phase::Build, frame, device_, stream_, *tracer_, scene_, 0, false))
                spare_.push_back(sample.reported.at(0).value);
        keptByRecording_ = device_.memoryUsedBytes() - before;
        return graph.memory().at(0);
    }
    std::string errorOf(const std::string& parameters) {
        return errorOf(parameters, device_.memoryLimitBytes());
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

    Device device_{{.name = "", .validation = true}};
    ShaderCompiler compiler_{test::sourceRoot(), {}};
    CommandStream stream_{device_};
    const SceneState state_ = evaluate(makeBuiltinScene("cornell", Value()), 0.0);
    const GpuScene scene_ = makeGpuScene(device_, stream_, state_);
    const std::unique_ptr<RayTracer> tracer_ = makeRayTracer(TracerKind::Embree, device_, compiler_, state_);
    PassMemory planned_;
    std::vector<double> spare_;  ///< Bytes, in each run.
    uint64_t keptByRecording_ = 0;
};

TEST_F(GraphMemory, DescribedBuffersArePlannedMadeAndFreed) {
    const uint64_t before = device_.memoryUsedBytes();
    const PassMemory taken = run("reserve_kept: 0");
    EXPECT_EQ(planned_.bytes, 256 * kKiB);
    EXPECT_EQ(planned_.scratchBytes, 256 * kKiB);
    EXPECT_EQ(taken.bytes, 256 * kKiB);
    EXPECT_EQ(taken.scratchBytes, 512 * kKiB);  // With what the stream stages for the upload.
    EXPECT_EQ(keptByRecording_, 0u);
    EXPECT_EQ(device_.memoryUsedBytes(), before);  // The graph is gone.
    EXPECT_TRUE(device_.validationMessages().empty());
}

TEST_F(GraphMemory, ReservationsHold) {
    const PassMemory taken = run(
        "reserve_kept: 3072, reserve_scratch: 1024, prepare_kept: 1024, record_kept: 2048, record_scratch: "
        "1024");
    EXPECT_EQ(taken.bytes, (256 + 3072) * kKiB);
    EXPECT_EQ(taken.scratchBytes, (512 + 1024) * kKiB);
    EXPECT_EQ(keptByRecording_, 2048 * kKiB);
    run("prepare_kept: 60");  // Less than alignment may take.
    run("record_scratch: 60");
}

TEST_F(GraphMemory, WhatIsTakenBeyondThemNamesThePass) {
    const auto expectError = [&](const std::string& parameters, uint64_t taken, const char* kind,
                                 uint64_t reserved) {
        const std::string error = errorOf(parameters);
        EXPECT_NE(error.find(fmt::format("pass 'greedy' takes {} bytes of {} memory", taken * kKiB, kind)),
                  std::string::npos)
            << error;
        EXPECT_NE(error.find(fmt::format("reserves {};", reserved * kKiB)), std::string::npos) << error;
    };
    expectError("prepare_kept: 128", 128, "kept", 0);
    expectError("record_kept: 128", 128, "kept", 0);
    expectError("record_scratch: 512", 512, "scratch", 0);
    expectError("reserve_kept: 1024, prepare_kept: 512, record_kept: 1024", 1536, "kept", 1024);
    expectError("reserve_scratch: 1024, record_scratch: 2048", 2048, "scratch", 1024);
    expectError("reserve_scratch: 1024, record_kept: 1024", 1024, "kept", 0);
}

TEST_F(GraphMemory, WhatIsTooLargeNamesThePassAndWhatToLower) {
    Registry registry;
    registry.add<Hoard>();
    const std::string advice =
        "lower what it grows with, of greedy.reserve_kept, greedy.prepare_kept, first.reserve_scratch, "
        "image.width, image.height";
    Graph graph(registry, parseYaml("- {pass: hoard, id: unread}\n"
                                    "- {pass: hoard, id: first, reserve_scratch: 1}\n"
                                    "- {pass: hoard, id: greedy, reserve_kept: 8192, prepare_kept: 8192}\n",
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
    EXPECT_EQ(planned.find("g.yaml:3: the graph needs about "), 0u) << planned;
    EXPECT_NE(planned.find("the largest part is greedy's kept with 8.0 MiB: " + advice), std::string::npos)
        << planned;

    const uint64_t limit = device_.memoryLimitBytes();
    graph.plan(frame, device_.info(), limit);
    device_.setMemoryLimitBytes(device_.memoryUsedBytes() + 4096 * kKiB);
    const std::string made = messageOf([&] { graph.prepare(frame, device_, compiler_, stream_); });
    device_.setMemoryLimitBytes(limit);
    EXPECT_EQ(made.find("g.yaml:3: greedy: 'kept' needs 8.0 MiB"), 0u) << made;
    EXPECT_NE(made.find(": " + advice), std::string::npos) << made;
    stream_.discard();
}

TEST_F(GraphMemory, WhatIsCountedMayTakeWhatTheLimitLeaves) {
    const uint64_t limit = (2 * 256 + 1024 + 512) * kKiB;  // What is described and reserved, and 512 KiB.
    EXPECT_EQ(run("reserve_counted: 1024, record_kept: 1536", limit).bytes, (256 + 1536) * kKiB);
    EXPECT_EQ(spare_, std::vector<double>(2, 512 * kKiB));
    EXPECT_EQ(planned_.bytes, (256 + 1024) * kKiB);
    EXPECT_NE(errorOf("reserve_counted: 1024, record_kept: 2048", limit).find("takes 2097152 bytes"),
              std::string::npos);
    // Not for what is reserved otherwise.
    EXPECT_NE(errorOf("reserve_kept: 1024, record_kept: 1536", limit).find("takes 1572864 bytes"),
              std::string::npos);
}

TEST(PlanMemo, AsksASceneOnceForAllItsVariants) {
    int asked = 0;
    const auto plan = [&](const std::shared_ptr<PlanMemo>& memo, const std::string& key) {
        Frame frame;
        frame.memo = memo;
        const std::vector<Resource*> resources;
        const DeviceInfo device;
        return PassPlan(resources, frame, device, Phase::Build).ofScene(key, [&] {
            return std::vector<int>{++asked};
        });
    };
    const auto memo = std::make_shared<PlanMemo>();
    EXPECT_EQ(plan(memo, "voxels of 16"), std::vector<int>{1});
    EXPECT_EQ(plan(memo, "voxels of 16"), std::vector<int>{1});
    EXPECT_EQ(plan(memo, "voxels of 32"), std::vector<int>{2});
    EXPECT_EQ(plan(memo, "voxels of 16"), std::vector<int>{1});
    EXPECT_EQ(plan(std::make_shared<PlanMemo>(), "voxels of 16"), std::vector<int>{3});  // Another scene.
    EXPECT_EQ(plan(nullptr, "voxels of 16"), std::vector<int>{4});
}

}  // namespace
}  // namespace voxray
