#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "base/files.h"
#include "experiment/runner.h"
#include "graph/graph.h"
#include "graph/reference_sums.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

/// Tiny passes that write constant images, and a folder for each test.
namespace voxray::fakes {

inline void planImage(PassPlan& plan, const Out<FrameImage>& port, const char* name) {
    ImageDesc desc;
    desc.extent = {plan.frame.width, plan.frame.height, 1};
    plan.image(plan[port].image, name, desc);
}

/// What a Witness writes: nothing, but whoever reads it needs the witness.
struct Testimony : Resource {};

/// Images to look at, in two formats.
struct LayerImages : Resource {
    Image wide, half;
    std::vector<Aov> aovs() const override { return {{&wide, {"P.X", "P.Y", "P.Z"}}, {&half, {"R", "G", "B"}}}; }
};

/// Writes `value` into final and half of it into indirect. Takes a witness where there is one.
class Constant : public Pass {
 public:
    static constexpr const char* kName = "constant";
    static constexpr const char* kHelp = "A constant image.";
    struct Params {
        float value = 1;
        float flicker = 0;
        float noise = 0;
        bool nan = false;
        bool fail = false;
        bool interrupt = false;
        bool interruptPlan = false;
        bool misuse = false;
        uint32_t megabytes = 0;
        static constexpr auto schema() {
            return std::tuple{
                field("value", &Params::value, "Radiance.", 0.0f, 100.0f),
                field("flicker", &Params::flicker, "Added to radiance in even frames, taken off in odd ones.", 0.0f,
                      1.0f),
                field("noise", &Params::noise, "Added to radiance with even seeds, taken off with odd ones.", 0.0f,
                      1.0f),
                field("nan", &Params::nan, "Write NaN instead."),
                field("fail", &Params::fail, "Throw with commands recorded."),
                field("interrupt", &Params::interrupt, "Raise SIGINT."),
                field("interrupt_plan", &Params::interruptPlan, "Raise SIGINT before anything is rendered."),
                field("misuse", &Params::misuse, "Use Vulkan in a way that it forbids."),
                field("megabytes", &Params::megabytes, "Memory to ask for.", 0u, 1u << 20)};
        }
    };
    static inline int runs = 0;
    static inline std::vector<float> cameraX;  ///< In the last runs.

    explicit Constant(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override {
        if (params_.interruptPlan) std::raise(SIGINT);
        planImage(plan, final_, "constant final");
        planImage(plan, indirect_, "constant indirect");
        ImageDesc desc;
        desc.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
        if (params_.misuse) plan.image(notToBeCleared_, "not to be cleared", desc);
        if (params_.megabytes > 0) plan.scratchBuffer(scratch_, "nothing", uint64_t(params_.megabytes) << 20);
    }
    void record(PassContext& context) override {
        ++runs;
        cameraX.push_back(context.frame.camera.position.x);
        if (params_.interrupt) std::raise(SIGINT);
        const float radiance = params_.value + (context.frameIndex % 2 ? -1 : 1) * params_.flicker +
                               (context.frame.seed % 2 ? -1 : 1) * params_.noise;
        const float value = params_.nan ? std::numeric_limits<float>::quiet_NaN() : radiance;
        context.stream.clear(context[final_].image, {{value, value, value, 1}});
        context.stream.clear(context[indirect_].image, {{value / 2, value / 2, value / 2, 1}});
        if (params_.misuse) context.stream.clear(notToBeCleared_, {});
        if (params_.fail) throw Error("the pass gave up");
        context.extraRays = 10;
    }

 private:
    const Params params_;
    Out<FrameImage> final_{*this, "final", "The image."};
    Out<FrameImage> indirect_{*this, "indirect", "Half of it."};
    InOptional<Testimony> testimony_{*this, "testimony", "Of a witness."};
    InOptional<LayerImages> layers_{*this, "layers", "To look at."};
    Image notToBeCleared_;
    Buffer scratch_;
};

/// A reference of radiance 1, whose halves are 1 - noise and 1 + noise. Of an odd number of samples the
/// second half has one more.
class Truth : public Pass {
 public:
    static constexpr const char* kName = "truth";
    static constexpr const char* kHelp = "A constant reference.";
    struct Params {
        uint32_t spp = 4;
        float noise = 0;
        bool fail = false;
        static constexpr auto schema() {
            return std::tuple{field("spp", &Params::spp, "Samples.", 1u, 1000u),
                              field("noise", &Params::noise, "Of each half.", 0.0f, 1.0f),
                              field("fail", &Params::fail, "Throw.")};
        }
    };
    static inline int runs = 0;
    static inline std::vector<uint64_t> seeds;  ///< Of each run.

    explicit Truth(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan&) override {}
    void record(PassContext& context) override {
        if (params_.fail) throw Error("no truth");
        ++runs;
        seeds.push_back(context.frame.seed + context.frameIndex);
        const Frame& frame = context.frame;
        const uint64_t first = frame.samples.first(params_.spp), end = frame.samples.end(params_.spp);
        for (uint64_t half = 0; half < 2; ++half) {
            const uint64_t samples = (end + half) / 2 - (first + half) / 2;
            const double value = 1 + (half ? params_.noise : -params_.noise);
            const auto fill = [&](SampleSums& sums, double mean) {
                sums = SampleSums(frame.width, frame.height, samples);
                std::ranges::fill(sums.data, mean * double(samples));
            };
            fill(context[sums_].final[half], value);
            fill(context[sums_].indirect[half], 0.5 * value);
        }
    }

 private:
    const Params params_;
    Out<ReferenceSums> sums_{*this, "sums", "A constant."};
};

/// Reads final and indirect and writes them again: something to wire.
class Relay : public Pass {
 public:
    static constexpr const char* kName = "relay";
    static constexpr const char* kHelp = "Reads what another pass writes.";
    struct Params {
        uint32_t steps = 1;
        static constexpr auto schema() { return std::tuple{field("steps", &Params::steps, "Steps.", 1u, 8u)}; }
    };
    explicit Relay(const Params&) {}
    Phase phase() const override { return Phase::Build; }
    void plan(PassPlan&) override {}
    void record(PassContext&) override {}

 private:
    In<FrameImage> before_{*this, "extra", "What to read."};
    Out<FrameImage> extra_{*this, "extra", "What it makes of it."};
};

/// Reads the image and writes it again.
class Veil : public Pass {
 public:
    static constexpr const char* kName = "veil";
    static constexpr const char* kHelp = "Over an image.";
    void plan(PassPlan&) override {}
    void record(PassContext&) override {}

 private:
    In<FrameImage> before_{*this, "final", "The image."};
    Out<FrameImage> final_{*this, "final", "The image again."};
};

/// Runs in the build phase and notes what it sees of the scene.
class Witness : public Pass {
 public:
    static constexpr const char* kName = "witness";
    static constexpr const char* kHelp = "Notes what it sees.";
    struct Sight {
        glm::vec3 corner;  ///< Last vertex of the scene.
        glm::vec3 light;   ///< Last light's position.
        int changed;       ///< Boxes; -1: everything is new.
        uint32_t frameIndex;
    };
    static inline std::vector<Sight> sights;

    Phase phase() const override { return Phase::Build; }
    void plan(PassPlan&) override {}
    void record(PassContext& context) override {
        const SceneState& state = *context.frame.scene;
        const auto& changed = context.frame.changed;
        sights.push_back({state.geometry.positions.back(), state.lights.back().position,
                          changed ? int(changed->size()) : -1, context.frameIndex});
    }

 private:
    Out<Testimony> testimony_{*this, "testimony", "That it was there."};
};

/// Writes images that nobody reads but to look at them.
class Layers : public Pass {
 public:
    static constexpr const char* kName = "layers";
    static constexpr const char* kHelp = "Images to look at.";
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override {
        LayerImages& layers = plan[layers_];
        ImageDesc desc;
        desc.extent = {plan.frame.width, plan.frame.height, 1};
        plan.image(layers.wide, "wide layer", desc);
        desc.format = VK_FORMAT_R16G16B16A16_SFLOAT;
        plan.image(layers.half, "half layer", desc);
    }
    void record(PassContext& context) override {
        const LayerImages& layers = context[layers_];
        context.stream.clear(layers.wide, {{1, 2, 3, 4}});
        context.stream.clear(layers.half, {{0.5f, 0.25f, 2, 1}});
    }

 private:
    Out<LayerImages> layers_{*this, "layers", "To look at."};
};

inline Registry registry() {
    Registry registry;
    registry.add<Constant>();
    registry.add<Truth>();
    registry.add<Relay>();
    registry.add<Veil>();
    registry.add<Witness>();
    registry.add<Layers>();
    return registry;
}

/// A folder for results and a cache of its own.
class RunTest : public testing::Test {
 protected:
    void SetUp() override {
        setenv("VOXRAY_CACHE", (root_ / "cache").c_str(), 1);
        Constant::runs = Truth::runs = 0;
        Truth::seeds.clear();
    }

    static std::string config(const std::string& rest) {
        return "name: fake\nscene: {builtin: cornell, lights: point}\nimage: {width: 8, height: 4}\n"
               "graph: [{pass: constant}]\nreference: {pass: truth}\nmeasure: {frames: 3, warmup: 1}\n" +
               rest;
    }
    RunOptions options() const {
        RunOptions o;
        o.out = root_ / "out";
        o.quiet = true;
        o.report = false;
        o.validation = true;
        o.sourceRoot = test::sourceRoot();
        return o;
    }
    RunSummary run(const std::string& rest, const RunOptions& o) const {
        return runExperiment(parseExperiment(config(rest), "fake.yaml"), o, registry());
    }
    RunSummary run(const std::string& rest) const { return run(rest, options()); }

    /// The cell of results.csv in a variant's row; quotes are dropped.
    std::string cell(const std::string& variant, const std::string& column) const {
        std::istringstream lines(readTextFile(root_ / "out" / "results.csv"));
        std::string line;
        std::getline(lines, line);
        const std::vector<std::string> header = split(line);
        while (std::getline(lines, line)) {
            const std::vector<std::string> fields = split(line);
            for (size_t i = 0; i < header.size(); ++i)
                if (header[i] == column && fields[0] == variant) return fields.at(i);
        }
        return "absent";
    }
    static std::vector<std::string> split(const std::string& line) {
        std::vector<std::string> fields{""};
        bool quoted = false;
        for (const char c : line) {
            if (c == '"')
                quoted = !quoted;
            else if (c == ',' && !quoted)
                fields.emplace_back();
            else
                fields.back() += c;
        }
        return fields;
    }
    const test::TemporaryFolder root_;
};

}  // namespace voxray::fakes
