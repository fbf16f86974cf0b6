// The frame graph by itself: no GL, a fake source of textures.

#include "runtime/frame/frame_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace blush {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Writes down what is asked of it.
class FakeTextures final : public TextureSource {
public:
    explicit FakeTextures(std::vector<std::string>& log) : log_(log) {}
    std::uint32_t acquire(const TextureShape& shape) override {
        log_.push_back("acquire " + std::to_string(shape.width));
        return shape.width + 1000;
    }
    void release(std::uint32_t handle, const TextureShape& shape) override {
        EXPECT_EQ(handle, shape.width + 1000);
        log_.push_back("release " + std::to_string(shape.width));
    }

private:
    std::vector<std::string>& log_;
};

class FrameGraphTest : public testing::Test {
protected:
    void add(const char* name) {
        graph_.pass(name, [this, name](const FrameGraph&) { log_.emplace_back(name); });
    }
    ResourceId texture(const char* name, std::uint32_t width = 1) { return graph_.texture(name, {.width = width}); }
    void run() {
        graph_.compile();
        graph_.execute(textures_);
    }
    const FrameResource& of(ResourceId id) { return graph_[id]; }

    FrameGraph graph_;
    std::vector<std::string> log_;
    FakeTextures textures_{log_};
};

TEST_F(FrameGraphTest, RunsWhatThePresentedNeedsInOrder) {
    const ResourceId a = graph_.import_buffer("a", 1, 3, 10), b = graph_.import_framebuffer("b", 2, {});
    add("first");
    graph_.writes(a);
    add("second");
    graph_.reads(a).writes(b);
    graph_.present(b);
    run();
    EXPECT_THAT(log_, ElementsAre("first", "second"));
}

TEST_F(FrameGraphTest, WithNothingPresentedNothingRuns) {
    const ResourceId a = texture("a");
    add("first");
    graph_.writes(a);
    add("no outputs");
    graph_.reads(a);
    run();
    EXPECT_THAT(log_, IsEmpty());
    for (const FramePass& pass : graph_.passes()) EXPECT_FALSE(pass.live);
}

TEST_F(FrameGraphTest, CullingCascades) {
    const ResourceId a = graph_.import_buffer("a", 1, 3, 1), b = graph_.import_buffer("b", 2, 3, 1),
                     c = graph_.import_buffer("c", 3, 3, 1), shown = graph_.import_buffer("shown", 4, 3, 1);
    add("makes a");
    graph_.writes(a);
    add("a to b");
    graph_.reads(a).writes(b);
    add("b to c");
    graph_.reads(b).writes(c);
    add("shows");
    graph_.writes(shown);
    graph_.present(shown);
    run();
    EXPECT_THAT(log_, ElementsAre("shows"));
}

TEST_F(FrameGraphTest, APlainWriteCutsEarlierWriters) {
    const ResourceId a = graph_.import_buffer("a", 1, 3, 1);
    add("overwritten");
    graph_.writes(a);
    add("modified in vain");
    graph_.modifies(a);
    add("last word");
    graph_.writes(a);
    graph_.present(a);
    run();
    EXPECT_THAT(log_, ElementsAre("last word"));
}

TEST_F(FrameGraphTest, AModificationKeepsEarlierWriters) {
    const ResourceId a = graph_.import_buffer("a", 1, 3, 1);
    add("writes");
    graph_.writes(a);
    add("modifies");
    graph_.modifies(a);
    add("modifies again");
    graph_.modifies(a);
    graph_.present(a);
    run();
    EXPECT_THAT(log_, ElementsAre("writes", "modifies", "modifies again"));
}

TEST_F(FrameGraphTest, AReaderBetweenTwoWritersKeepsTheFirst) {
    const ResourceId a = graph_.import_buffer("a", 1, 3, 1), b = graph_.import_buffer("b", 2, 3, 1);
    add("first a");
    graph_.writes(a);
    add("a to b");
    graph_.reads(a).writes(b);
    add("second a");
    graph_.writes(a);
    graph_.present(a);
    graph_.present(b);
    run();
    EXPECT_THAT(log_, ElementsAre("first a", "a to b", "second a"));
}

TEST_F(FrameGraphTest, APassThatReadsAndWritesOneResourceKeepsWhatItReads) {
    const ResourceId a = graph_.import_buffer("a", 1, 3, 1);
    add("writes");
    graph_.writes(a);
    add("reads and writes");
    graph_.reads(a).writes(a);
    graph_.present(a);
    run();
    EXPECT_THAT(log_, ElementsAre("writes", "reads and writes"));
}

TEST_F(FrameGraphTest, TexturesLiveFromFirstToLastLiveUse) {
    const ResourceId a = texture("a", 11), b = texture("b", 12), unused = texture("unused", 13);
    const ResourceId shown = graph_.import_framebuffer("shown", 5, {});
    add("p0");
    graph_.writes(a);
    add("p1");
    graph_.reads(a).writes(b);
    add("culled");
    graph_.reads(b).writes(unused);
    add("p3");
    graph_.reads(b).writes(shown);
    graph_.present(shown);
    run();
    EXPECT_THAT(log_, ElementsAre("acquire 11", "p0", "acquire 12", "p1", "release 11", "p3", "release 12"));
    EXPECT_EQ(of(a).first_use, 0);
    EXPECT_EQ(of(a).last_use, 1);
    EXPECT_EQ(of(b).first_use, 1);
    EXPECT_EQ(of(b).last_use, 3);
    EXPECT_EQ(of(unused).first_use, -1);
    EXPECT_EQ(of(unused).last_use, -1);
}

TEST_F(FrameGraphTest, ATextureOfOnePassIsTakenAndGivenBackAroundIt) {
    const ResourceId a = texture("a", 11), shown = graph_.import_buffer("shown", 5, 3, 1);
    add("p0");
    graph_.writes(a).writes(shown);
    graph_.present(shown);
    run();
    EXPECT_THAT(log_, ElementsAre("acquire 11", "p0", "release 11"));
}

TEST_F(FrameGraphTest, APassSeesTheHandlesOfItsTextures) {
    const ResourceId a = texture("a", 11), shown = graph_.import_framebuffer("shown", 77, {});
    static ResourceId wanted;
    wanted = a;
    static std::uint32_t seen;
    seen = 0;
    graph_.pass("p", [](const FrameGraph& graph) { seen = graph[wanted].handle; }).writes(a).writes(shown);
    graph_.present(shown);
    run();
    EXPECT_EQ(seen, 1011U);
    EXPECT_EQ(of(shown).handle, 77U);
}

TEST_F(FrameGraphTest, ObserversStandAroundLivePassesOnly) {
    const ResourceId a = graph_.import_buffer("a", 1, 3, 1), b = graph_.import_buffer("b", 2, 3, 1);
    add("culled");
    graph_.writes(b);
    add("p");
    graph_.writes(a);
    graph_.present(a);
    graph_.compile();
    graph_.execute(
        textures_,
        [&](const FrameGraph&, const FramePass& pass) { log_.push_back("before " + std::string(pass.name)); },
        [&](const FrameGraph&, const FramePass& pass) { log_.push_back("after " + std::string(pass.name)); });
    EXPECT_THAT(log_, ElementsAre("before p", "p", "after p"));
}

TEST_F(FrameGraphTest, EachOutputVisitsWhatIsWrittenOrModified) {
    const ResourceId a = graph_.import_buffer("a", 1, 3, 1), b = graph_.import_buffer("b", 2, 3, 1),
                     c = graph_.import_buffer("c", 3, 3, 1);
    add("p");
    graph_.reads(a).writes(b).modifies(c);
    std::vector<std::string> outputs;
    graph_.each_output(graph_.passes()[0], [&](const FrameResource& resource) { outputs.emplace_back(resource.name); });
    EXPECT_THAT(outputs, ElementsAre("b", "c"));
}

TEST_F(FrameGraphTest, ClearForgetsEverything) {
    const ResourceId a = graph_.import_buffer("a", 1, 3, 1);
    add("p");
    graph_.writes(a);
    graph_.present(a);
    run();
    graph_.clear();
    log_.clear();
    run();
    EXPECT_THAT(log_, IsEmpty());
    EXPECT_TRUE(graph_.passes().empty());
    EXPECT_TRUE(graph_.resources().empty());
}

}  // namespace
}  // namespace blush
