// Wiring and checking of graphs, with passes that do nothing.
#include <gtest/gtest.h>

#include "config/yaml.h"
#include "graph/graph.h"
#include "tests/support/errors.h"

namespace voxray {
namespace {

enum class Smooth { None, Near, OverVoxels };

}  // namespace

template <>
struct EnumNames<Smooth> {
    static constexpr std::array names{std::pair{Smooth::None, "none"}, std::pair{Smooth::Near, "near"},
                                      std::pair{Smooth::OverVoxels, "over_voxels"}};
};

namespace {

struct Voxels : Resource {};
struct Light : Resource {};

// A pass that does nothing but have ports.
struct Idle : Pass {
    void plan(PassPlan& plan) override { plan.buffer(results, "results", 1u << 20); }
    Buffer results;
    void record(PassContext&) override {}
};

struct MakeVoxels : Idle {
    static constexpr const char* kName = "make_voxels";
    static constexpr const char* kHelp = "Writes voxels.";
    struct Params {
        uint32_t resolution = 64;
        bool fine = false;
        static constexpr auto schema() {
            return std::tuple{field("resolution", &Params::resolution, "Voxels along a side.", 1u, 512u),
                              field("fine", &Params::fine, "Twice as fine.")};
        }
    };
    explicit MakeVoxels(const Params&) {}
    Out<Voxels> voxels{*this, "voxels", "the voxels"};
};

struct LightVoxels : Idle {
    static constexpr const char* kName = "light_voxels";
    static constexpr const char* kHelp = "Reads voxels, writes light.";
    In<Voxels> voxels{*this, "voxels", "voxels to light"};
    InOptional<Light> before{*this, "light", "light of before"};
    Out<Light> light{*this, "light", "their light"};
};

struct WrongType : Idle {
    static constexpr const char* kName = "wrong_type";
    static constexpr const char* kHelp = "Reads light under the name of voxels.";
    In<Light> voxels{*this, "voxels", "not voxels at all"};
};

// Changes light; over voxels where it is asked to.
struct ChangeLight : Idle {
    static constexpr const char* kName = "change_light";
    static constexpr const char* kHelp = "Reads light, writes light.";
    struct Params {
        Smooth smooth = Smooth::None;
        static constexpr auto schema() { return std::tuple{field("smooth", &Params::smooth, "How.")}; }
    };
    explicit ChangeLight(const Params& p) : params(p) {}
    const Params params;
    In<Light> before{*this, "light", "light to change"};
    In<Voxels> voxels{*this, "voxels", "where light is", params.smooth == Smooth::OverVoxels};
    Out<Light> light{*this, "light", "changed light"};
};

// Keeps 1 MiB, and needs more for a while.
struct SumUp : Idle {
    static constexpr const char* kName = "sum_up";
    static constexpr const char* kHelp = "Writes light.";
    struct Params {
        uint32_t mib = 1;
        static constexpr auto schema() { return std::tuple{field("mib", &Params::mib, "MiB of scratch.", 0u, 64u)}; }
    };
    explicit SumUp(const Params& p) : params(p) {}
    void plan(PassPlan& plan) override {
        plan.buffer(kept, "light", 1u << 20);
        plan.scratchBuffer(sums, "sums", uint64_t(params.mib) << 20);
    }
    const Params params;
    Buffer kept, sums;
    Out<Light> light{*this, "light", "the light"};
};

// Runs in each frame.
struct Blink : Idle {
    static constexpr const char* kName = "blink";
    static constexpr const char* kHelp = "Writes light in each frame.";
    Phase phase() const override { return Phase::Frame; }
    Out<Light> light{*this, "light", "the light"};
};

// Keeps a byte for an output that is read, and two for the other.
struct TwoOutputs : Idle {
    static constexpr const char* kName = "two_outputs";
    static constexpr const char* kHelp = "Writes light and spare light.";
    void plan(PassPlan& plan) override {
        if (plan[light].isRead) plan.buffer(kept, "light", 1);
        if (plan[spare].isRead) plan.buffer(keptSpare, "spare", 2);
    }
    Buffer kept, keptSpare;
    InOptional<Light> before{*this, "before", "any light"};
    Out<Light> light{*this, "light", "the light"};
    Out<Light> spare{*this, "spare", "more light"};
};

// Only reports.
struct CountVoxels : Idle {
    static constexpr const char* kName = "count_voxels";
    static constexpr const char* kHelp = "Counts voxels.";
    In<Voxels> voxels{*this, "voxels", "voxels to count"};
};

Registry registry() {
    Registry r;
    r.add<MakeVoxels>();
    r.add<LightVoxels>();
    r.add<WrongType>();
    r.add<SumUp>();
    r.add<Blink>();
    r.add<TwoOutputs>();
    r.add<CountVoxels>();
    r.add<ChangeLight>();
    r.renamed("light_all_voxels", "light_voxels with 'which: all'");
    return r;
}

Graph graph(const std::string& yaml) {
    return Graph(registry(), parseYaml(yaml, "g.yaml"));
}

std::string wiringError(const std::string& yaml) {
    return errorOf<UsageError>([&] { graph(yaml); });
}

TEST(GraphWiring, TakesTheNearestEarlierWriter) {
    const Graph g = graph("[{pass: make_voxels}, {pass: light_voxels, id: a}, {pass: light_voxels, id: b}]");
    const auto passes = g.passes();
    ASSERT_EQ(passes.size(), 3u);
    EXPECT_EQ(passes[1].id, "a");
    EXPECT_EQ(passes[2].id, "b");
    EXPECT_TRUE(g.writes("light"));
    EXPECT_FALSE(g.writes("indirect"));
}

TEST(GraphWiring, WhatIsChangedAfterItWasReadIsRefused) {
    const std::string late = "- {pass: make_voxels}\n- {pass: light_voxels}\n- {pass: make_voxels, id: late}\n";
    const std::string message = errorOf<UsageError>([&] { graph(late).checkReadsLatest("light", "voxels"); });
    EXPECT_CONTAINS(message, "g.yaml:3: late: ");
    EXPECT_CONTAINS(message, "'late'");

    // In order, chosen on purpose, or not made of it at all
    graph("- {pass: make_voxels}\n- {pass: light_voxels}\n").checkReadsLatest("light", "voxels");
    graph("- {pass: make_voxels, id: a}\n- {pass: light_voxels, inputs: {voxels: a}}\n- {pass: make_voxels}\n")
        .checkReadsLatest("light", "voxels");
    graph("- {pass: make_voxels}\n- {pass: sum_up}\n").checkReadsLatest("light", "voxels");
}

TEST(GraphWiring, SortsWritersBeforeReaders) {
    const Graph g = graph("- {pass: light_voxels, inputs: {voxels: late}}\n- {pass: make_voxels, id: late}\n");
    EXPECT_EQ(g.passes()[0].id, "late");
}

TEST(GraphWiring, ReadersOfFramePassesRunInEachFrame) {
    const Graph g = graph(
        "[{pass: make_voxels}, {pass: light_voxels, id: once}, {pass: light_voxels, id: second, inputs: {light: "
        "first}}, {pass: light_voxels, id: first, inputs: {light: blink}}, {pass: blink}]");
    const auto passes = g.passes();
    ASSERT_EQ(passes.size(), 5u);
    for (const Graph::PassInfo& pass : passes)
        EXPECT_EQ(pass.phase, pass.id == "make_voxels" || pass.id == "once" ? Phase::Build : Phase::Frame) << pass.id;
}

TEST(GraphWiring, RecordsEveryDefault) {
    const Graph g = graph("[{pass: make_voxels, fine: true}]");
    EXPECT_EQ(g.resolved().text(), "[{pass: make_voxels, resolution: 64, fine: true}]");
}

TEST(GraphWiring, KeepsOnlyWhatIsAskedFor) {
    Graph g = graph(
        "[{pass: make_voxels}, {pass: make_voxels, id: unread}, {pass: light_voxels, id: a, inputs: {voxels: "
        "make_voxels}}, {pass: light_voxels, id: reads_unread, inputs: {light: a}}, {pass: light_voxels, id: "
        "b, inputs: {voxels: make_voxels, light: a}}]");
    EXPECT_EQ(g.cullUnused({"light", "indirect"}), (std::vector<std::string>{"unread", "reads_unread"}));
    const auto passes = g.passes();
    ASSERT_EQ(passes.size(), 3u);
    EXPECT_EQ(passes[0].id, "make_voxels");
    EXPECT_EQ(passes[1].id, "a");
    EXPECT_EQ(passes[2].id, "b");
    EXPECT_EQ(g.cullUnused({"light"}), std::vector<std::string>{});
}

TEST(GraphWiring, TellsWhyAPassIsLeftOut) {
    const Graph g = graph(
        "- {pass: make_voxels}\n- {pass: make_voxels, id: nearer}\n- {pass: light_voxels}\n"
        "- {pass: make_voxels, id: late}\n");
    const std::string overwritten = g.whyCulled("make_voxels");
    EXPECT_CONTAINS(overwritten, "g.yaml:1: 'make_voxels'");
    EXPECT_CONTAINS(overwritten, "write 'inputs: {voxels: make_voxels}' in what shall read it");
    EXPECT_CONTAINS(g.whyCulled("late"), "g.yaml:4: 'late'");

    const Graph chain = graph(
        "- {pass: make_voxels}\n- {pass: make_voxels, id: unread}\n"
        "- {pass: light_voxels, id: a, inputs: {voxels: make_voxels}}\n"
        "- {pass: light_voxels, id: reads_unread, inputs: {light: a}}\n"
        "- {pass: light_voxels, id: b, inputs: {voxels: make_voxels, light: a}}\n");
    EXPECT_CONTAINS(chain.whyCulled("unread"), "'reads_unread'");
    EXPECT_CONTAINS(chain.whyCulled("reads_unread"), "'b'");
}

TEST(GraphWiring, TellsProducersWhatIsRead) {
    // From outside, only the last output of a name can be read; cullUnused says which names are.
    const auto bytes = [](Graph g) {
        std::vector<uint64_t> all;
        for (const PassMemory& pass : g.plan(Frame(), DeviceInfo(), 1u << 20)) all.push_back(pass.bytes);
        return all;
    };
    EXPECT_EQ(bytes(graph("[{pass: two_outputs}, {pass: two_outputs, id: last}]")), (std::vector<uint64_t>{0, 3}));
    const std::string linked =
        "[{pass: two_outputs}, {pass: two_outputs, id: last, inputs: {before: two_outputs.light}}]";
    EXPECT_EQ(bytes(graph(linked)), (std::vector<uint64_t>{1, 3}));
    Graph kept = graph(linked);
    kept.cullUnused({"spare"});
    EXPECT_EQ(bytes(std::move(kept)), (std::vector<uint64_t>{1, 2}));
}

TEST(GraphWiring, KeepsWhatOnlyReports) {
    Graph g = graph(
        "[{pass: make_voxels}, {pass: light_voxels}, {pass: make_voxels, id: counted}, {pass: count_voxels}, {pass: "
        "make_voxels, id: unread}]");
    EXPECT_EQ(g.cullUnused({"light"}), std::vector<std::string>{"unread"});
    EXPECT_EQ(g.passes().back().id, "count_voxels");
}

TEST(GraphWiring, NamesPlaceAndNearestWord) {
    const std::string unknownPass = wiringError("- {pass: make_voxels}\n- {pass: light_voxel}\n");
    EXPECT_CONTAINS(unknownPass, "g.yaml:2");
    EXPECT_CONTAINS(unknownPass, "'light_voxels'");
    const std::string unknownParameter = wiringError("- pass: make_voxels\n  resolutoin: 3\n");
    EXPECT_CONTAINS(unknownParameter, "g.yaml:2");
    EXPECT_CONTAINS(unknownParameter, "'resolution'");
    EXPECT_CONTAINS(wiringError("[{pass: make_voxels, resolution: 513}]"), "out of range [1, 512]");
    EXPECT_CONTAINS(wiringError("[{pass: make_voxels, resolution: many}]"), "'many'");
    EXPECT_CONTAINS(wiringError("[{pass: make_voxels, fine: 1}]"), "expected true or false");
}

TEST(GraphWiring, TellsWhatStandsInPlaceOfANameOfBefore) {
    EXPECT_EQ(wiringError("- {pass: make_voxels}\n- {pass: light_all_voxels}\n"),
              "g.yaml:2: 'light_all_voxels' is now light_voxels with 'which: all'");
}

TEST(GraphWiring, RefusesBadGraphs) {
    const std::string missing = wiringError("\n- {pass: light_voxels}\n");
    EXPECT_CONTAINS(missing, "g.yaml:2");
    EXPECT_CONTAINS(missing, "'voxels'");
    EXPECT_CONTAINS(missing, "these can: make_voxels");
    EXPECT_CONTAINS(wiringError("[{pass: light_voxels}, {pass: make_voxels}]"), "writes only later");
    EXPECT_CONTAINS(wiringError("[{pass: make_voxels}, {pass: make_voxels}]"), "'make_voxels'");
    EXPECT_CONTAINS(wiringError("[{pass: make_voxels}, {pass: wrong_type}]"), "of another type");
    EXPECT_CONTAINS(wiringError("[{pass: make_voxels}, {pass: light_voxels, inputs: {voxel: make_voxels}}]"),
                    "'voxels'");
    EXPECT_CONTAINS(wiringError("[{pass: make_voxels}, {pass: light_voxels, inputs: {voxels: make_voxel}}]"),
                    "'make_voxels'");
    EXPECT_CONTAINS(wiringError("- {pass: make_voxels}\n"
                                "- {pass: light_voxels, id: a, inputs: {light: b}}\n"
                                "- {pass: light_voxels, id: b, inputs: {light: a}}\n"),
                    "cycle between a, b");
    EXPECT_CONTAINS(wiringError("{pass: make_voxels}"), "expected a list of passes");
    EXPECT_CONTAINS(wiringError("[gbuffer]"), "each entry is a map");
}

TEST(GraphWiring, TellsWritersThatDoNotReadWhatTheyWrite) {
    const std::string missing = wiringError("\n- {pass: change_light}\n");
    EXPECT_CONTAINS(missing, "these can: light_voxels, sum_up");
    EXPECT_EQ(missing.find("change_light,"), std::string::npos);
}

TEST(GraphWiring, DescribesPortsThatOnlySomeValuesAskFor) {
    Registry registry;
    registry.add<ChangeLight>();
    std::string all;
    for (const PortDoc& port : registry.require("change_light", {}).ports)
        all += fmt::format("{}{}[{}] ", port.output ? "-> " : "", port.name, port.with);
    EXPECT_EQ(all, "light[] -> light[] voxels[smooth: over_voxels] ");
}

TEST(GraphPlan, RefusesMoreMemoryThanThereIs) {
    Graph g = graph("[{pass: make_voxels}, {pass: light_voxels}]");
    const SceneState state;
    Frame frame;
    frame.scene = &state;
    const std::vector<PassMemory> memory = g.plan(frame, {}, 2u << 20);
    ASSERT_EQ(memory.size(), 2u);
    for (const PassMemory& pass : memory) EXPECT_EQ(pass.bytes, 1u << 20);
    const std::string error = errorOf([&] { g.plan(frame, {}, (2u << 20) - 1); });
    EXPECT_CONTAINS(error, "needs 2.0 MiB, the limit is 2.0 MiB");
    EXPECT_CONTAINS(error, "make_voxels's results");
}

TEST(GraphPlan, ScratchOfOnePassIsFreeForTheNext) {
    EXPECT_EQ(peakBytes({}), 0u);
    EXPECT_EQ(peakBytes({{5, 0}, {7, 0}}), 12u);
    EXPECT_EQ(peakBytes({{5, 30}, {7, 40}, {1, 20}}), 13u + 40u);

    // Two passes that keep 1 MiB each, and need 2 and 3 MiB for a while.
    Graph g = graph("[{pass: sum_up, mib: 2}, {pass: sum_up, id: more, mib: 3}]");
    const SceneState state;
    Frame frame;
    frame.scene = &state;
    const std::vector<PassMemory> memory = g.plan(frame, {}, 5u << 20);
    EXPECT_EQ(memory.at(0).scratchBytes, 2u << 20);
    EXPECT_EQ(memory.at(1).scratchBytes, 3u << 20);
    const std::string error = errorOf([&] { g.plan(frame, {}, (5u << 20) - 1); });
    EXPECT_CONTAINS(error, "needs 5.0 MiB");
    EXPECT_CONTAINS(error, "more's sums with 3.0 MiB");
}

}  // namespace
}  // namespace voxray
