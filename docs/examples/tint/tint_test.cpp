#include <gtest/gtest.h>

#include "graph/graph.h"
#include "scene/load.h"
#include "tests/support/device.h"
#include "tests/support/places.h"

namespace voxray {
namespace {

/// Stands in for the chain before the pass: an image of one known value.
class KnownImage final : public Pass {
 public:
    static constexpr const char* kName = "known_image";
    static constexpr const char* kHelp = "An image of radiance (1, 2, 3).";
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override { plan.frameImage(source_); }
    void record(PassContext& context) override {
        context.stream.clear(context[source_].image, VkClearColorValue{{1.0f, 2.0f, 3.0f, 1.0f}});
    }

 private:
    Out<FrameImage> source_{*this, "source", "The image."};
};

Registry registryWithTint() {
    Registry registry;
    registry.add<KnownImage>();
    addRegistered(registry, "docs/examples/tint/");
    return registry;
}

Value entry(const std::string& pass) {
    Value map = Value::map();
    map.set("pass", Value::fromScalar(pass));
    return map;
}

TEST(TemplatePass, MultipliesEveryPixelByTheColour) {
    Value tint = entry("tint");
    Value color = Value::list();
    for (const char* factor : {"0.5", "0.25", "2"}) color.items.push_back(Value::fromScalar(factor));
    tint.set("color", color);
    Value list = Value::list();
    list.items = {entry("known_image"), tint};

    Device& device = test::device();
    ShaderCompiler compiler(test::sourceRoot(), {});
    CommandStream stream(device);
    const SceneState state = evaluate(makeBuiltinScene("cornell", Value()), 0.0);
    const GpuScene scene = makeGpuScene(device, stream, state);
    const std::unique_ptr<RayTracer> tracer = makeRayTracer(TracerKind::Embree, device, compiler, state);

    const Registry registry = registryWithTint();
    Graph graph(registry, list);

    // An odd size: the last work groups hang over the edge.
    Frame frame;
    frame.scene = &state;
    frame.width = 13;
    frame.height = 9;
    graph.plan(frame, device.info(), device.memoryLimitBytes());
    graph.prepare(frame, device, compiler, stream);
    graph.run(Phase::Frame, frame, device, stream, *tracer, scene, 0, true);

    const Image* image = graph.image("final");
    ASSERT_NE(image, nullptr);
    const Buffer pixels(device, "pixels", 13 * 9 * 4 * sizeof(float), MemoryKind::Readback);
    stream.copy(*image, pixels);
    const std::vector<float> values = stream.readAs<float>(pixels, 13 * 9 * 4);
    for (size_t p = 0; p < 13 * 9; ++p) {
        ASSERT_EQ(values[p * 4 + 0], 0.5f) << p;
        ASSERT_EQ(values[p * 4 + 1], 0.5f) << p;
        ASSERT_EQ(values[p * 4 + 2], 6.0f) << p;
    }
}

TEST(TemplatePass, RefusesAParameterOutOfRange) {
    Value tint = entry("tint");
    tint.set("color", Value::fromScalar("-1"));
    Value list = Value::list();
    list.items = {entry("known_image"), tint};
    const Registry registry = registryWithTint();
    EXPECT_THROW(Graph(registry, list), UsageError);
}

}  // namespace
}  // namespace voxray
