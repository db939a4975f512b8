// FrameGraph: what it refuses, what it keeps, what it reuses.
#include "lab/compute.h"
#include "server/gl/gl_error.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

constexpr Extent kFrameGraphExtent{16, 8};

constexpr const char* kAddOne = R"(#version 450
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D in_value;
uniform writeonly image2D out_value;
uniform float amount;
void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    imageStore(out_value, px, texelFetch(in_value, px, 0) + amount);
}
)";

constexpr const char* kFill = R"(#version 450
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D out_value;
uniform float amount;
void main() { imageStore(out_value, ivec2(gl_GlobalInvocationID.xy), vec4(amount)); }
)";

class FrameGraphTest : public GlTest {
protected:
    FrameGraphTest()
    {
        add_shader_file("tests/add_one", kAddOne);
        add_shader_file("tests/fill", kFill);
        graph.begin_frame(kFrameGraphExtent, {});
    }
    void fill(TextureHandle texture, float amount)
    {
        graph.add_pass("fill", "tests/fill").write("out_value", texture).constant("amount", amount);
    }
    TextureHandle filled(float amount)
    {
        const TextureHandle texture = graph.create("filled", GL_RGBA32F);
        fill(texture, amount);
        return texture;
    }
    TextureHandle plus(TextureHandle texture, float amount)
    {
        const TextureHandle sum = graph.create("sum", GL_RGBA32F);
        graph.add_pass("add", "tests/add_one")
            .read("in_value", texture)
            .write("out_value", sum)
            .constant("amount", amount);
        return sum;
    }
    float value_of(TextureHandle texture)
    {
        Readback readback;
        readback.begin(graph.texture(texture));
        const Extent extent = graph.texture(texture).extent();
        return pixel(readback.finish(), extent.width - 1, extent.height - 1).x;
    }
    void expect_refused(const std::string& part_a, const std::string& part_b)
    {
        try {
            graph.execute();
            FAIL() << "not refused";
        } catch (const ShaderError& error) {
            EXPECT_NE(std::string(error.what()).find(part_a), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(part_b), std::string::npos) << error.what();
        }
    }

    ProgramCache programs;
    FrameGraph graph{programs, true, true};
};

TEST_F(FrameGraphTest, PassesRunInOrderAndSeeEachOthersWrites)
{
    TextureHandle texture = filled(1);
    for (int i = 0; i < 10; ++i)
        texture = plus(texture, 1);
    graph.keep(texture);
    graph.execute();
    EXPECT_EQ(value_of(texture), 11);
    EXPECT_EQ(graph.pass_names().size(), 11U);
    EXPECT_EQ(graph.collect_times().size(), 11U);
}

/// Ten passes in a row need two textures, not eleven.
TEST_F(FrameGraphTest, TransientMemoryIsReused)
{
    TextureHandle texture = filled(1);
    for (int i = 0; i < 10; ++i)
        texture = plus(texture, 1);
    graph.execute();
    EXPECT_EQ(graph.texture_bytes(), 2U * 16 * kFrameGraphExtent.width * kFrameGraphExtent.height);
}

/// Memory that a pass still reads is written again only behind a barrier, even if the writer reads
/// nothing of it.
TEST_F(FrameGraphTest, AWriteWaitsForReadersOfTheMemoryItReuses)
{
    const TextureHandle a = filled(1);
    const TextureHandle sum = plus(a, 1);  // reads a, whose memory is free from here on
    const TextureHandle b = filled(5);  // takes it
    graph.keep(sum);
    graph.keep(b);
    graph.execute();
    EXPECT_EQ(graph.barrier_count(), 2);  // before `add` reads a, before `fill` writes over it
    EXPECT_EQ(value_of(sum), 2);
    EXPECT_EQ(value_of(b), 5);
}

TEST_F(FrameGraphTest, PassesThatShareNothingNeedNoBarrier)
{
    filled(1);
    graph.keep(filled(2));
    graph.keep(filled(3));
    graph.execute();
    EXPECT_LE(graph.barrier_count(), 1);  // the first texture's memory may be reused
}

TEST_F(FrameGraphTest, HistoryIsLastFramesCurrent)
{
    for (int frame = 0; frame < 5; ++frame) {
        graph.begin_frame(kFrameGraphExtent, {});
        const History history = graph.history("count", GL_RGBA32F);
        EXPECT_EQ(history.valid, frame > 0);
        graph.add_pass("add", "tests/add_one")
            .read("in_value", history.previous)
            .write("out_value", history.current)
            .constant("amount", 1.0F);
        graph.execute();
        EXPECT_EQ(value_of(history.current), static_cast<float>(frame + 1));
    }
}

TEST_F(FrameGraphTest, APassMayReadOneTextureByTwoNames)
{
    add_shader_file("tests/add_both", R"(#version 450
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D in_a;
uniform sampler2D in_b;
uniform writeonly image2D out_value;
void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    imageStore(out_value, px, texelFetch(in_a, px, 0) + texelFetch(in_b, px, 0));
}
)");
    const TextureHandle one = filled(3);
    const TextureHandle sum = graph.create("sum", GL_RGBA32F);
    graph.add_pass("both", "tests/add_both")
        .read("in_a", one)
        .read("in_b", one)
        .write("out_value", sum);
    graph.keep(sum);
    graph.execute();
    EXPECT_EQ(value_of(sum), 6);
}

TEST_F(FrameGraphTest, HistoryIsInvalidAfterAFrameThatDidNotWriteItAndWhenForgotten)
{
    const auto write = [&](Extent extent) {
        graph.begin_frame(extent, {});
        const History history = graph.history("count", GL_RGBA32F);
        fill(history.current, 1);
        graph.execute();
        return history.valid;
    };
    EXPECT_FALSE(write(kFrameGraphExtent));
    EXPECT_TRUE(write(kFrameGraphExtent));
    graph.begin_frame(kFrameGraphExtent, {});  // a frame without the pass
    graph.execute();
    EXPECT_FALSE(write(kFrameGraphExtent));
    EXPECT_TRUE(write(kFrameGraphExtent));
    EXPECT_TRUE(write({8, 8})) << "histories outlive a change of size";
    graph.forget_histories();
    EXPECT_FALSE(write({8, 8}));
}

TEST_F(FrameGraphTest, AHistoryKeepsItsSizeUntilItIsWrittenAnew)
{
    const auto draw = [&](Extent extent, float amount) {
        graph.begin_frame(extent, {});
        const History history = graph.history("count", GL_RGBA32F);
        fill(history.current, amount);
        graph.execute();
        return history;
    };
    draw(kFrameGraphExtent, 1);
    const History smaller = draw({8, 8}, 2);
    EXPECT_EQ(graph.texture(smaller.previous).extent(), kFrameGraphExtent);
    EXPECT_EQ(value_of(smaller.previous), 1);
    EXPECT_EQ(graph.texture(smaller.current).extent(), (Extent{8, 8}));
    EXPECT_EQ(value_of(draw({8, 8}, 3).previous), 2);
}

/// What the last frame kept has its size and must not serve the next one, which has another.
TEST_F(FrameGraphTest, AfterAResizeEveryTextureHasTheNewSize)
{
    const auto draw = [&](Extent extent) {
        graph.forget_histories();
        graph.begin_frame(extent, {});
        const History history = graph.history("count", GL_RGBA32F);
        graph.add_pass("fill", "tests/fill")
            .write("out_value", history.current)
            .constant("amount", 1.0F);
        const TextureHandle sum = plus(history.current, 1);
        const TextureHandle copy = filled(3);
        graph.keep(sum);
        graph.keep(copy);
        graph.execute();
        for (const TextureHandle texture : {history.current, history.previous, sum, copy})
            EXPECT_EQ(graph.texture(texture).extent(), extent);
        EXPECT_EQ(graph.texture_bytes(), 4U * 16 * extent.width * extent.height);
    };
    for (const Extent extent : {kFrameGraphExtent, Extent{24, 16}, Extent{8, 8}, kFrameGraphExtent})
        draw(extent);
}

TEST_F(FrameGraphTest, WhatFramesNoLongerDeclareIsFreed)
{
    const auto frame = [&](bool all) {
        graph.begin_frame(kFrameGraphExtent, {});
        filled(1);
        if (all) {
            fill(graph.history("h", GL_RGBA32F).current, 2);
            fill(graph.create("half", GL_RGBA16F), 3);
        }
        graph.execute();
        return graph.texture_bytes();
    };
    const std::size_t least = frame(false);
    const std::size_t most = frame(true);
    EXPECT_GT(most, least);
    for (int i = 0; i < FrameGraph::kIdleFrames; ++i)
        frame(i % 2 == 0);
    EXPECT_EQ(frame(true), most) << "what is used in turns is kept";
    for (int i = 0; i < FrameGraph::kIdleFrames; ++i)
        frame(false);
    EXPECT_EQ(frame(false), least);
}

TEST_F(FrameGraphTest, RefusesAConstantTheShaderDoesNotUse)
{
    const TextureHandle texture = graph.create("t", GL_RGBA32F);
    graph.add_pass("fill", "tests/fill")
        .write("out_value", texture)
        .constant("amount", 1.0F)
        .constant("variance_epsilon", 1e-4F);
    expect_refused("pass 'fill': 'variance_epsilon'", "is declared but the shader does not use it");
}

TEST_F(FrameGraphTest, RefusesAVariableNobodyDeclared)
{
    graph.add_pass("fill", "tests/fill").write("out_value", graph.create("t", GL_RGBA32F));
    expect_refused("pass 'fill': 'amount'", "is used by the shader but not declared");
}

TEST_F(FrameGraphTest, RefusesAConstantOfAnotherType)
{
    graph.add_pass("fill", "tests/fill")
        .write("out_value", graph.create("t", GL_RGBA32F))
        .constant("amount", 1);
    expect_refused("pass 'fill': 'amount'", "not declared with this kind and type");
}

TEST_F(FrameGraphTest, RefusesReadingWhatNobodyWrote)
{
    plus(graph.create("nothing", GL_RGBA32F), 1);
    expect_refused(
        "pass 'add': 'in_value'", "reads texture 'nothing' before any pass has written it");
}

TEST_F(FrameGraphTest, RefusesWritingToASampler)
{
    const TextureHandle a = filled(1);
    const TextureHandle b = graph.create("b", GL_RGBA32F);
    graph.add_pass("add", "tests/add_one")
        .write("in_value", a)
        .write("out_value", b)
        .constant("amount", 1.0F);
    expect_refused("pass 'add': 'in_value'", "not declared with this kind and type");
}

TEST_F(FrameGraphTest, AShaderThatDoesNotCompileNamesItsFileAndLog)
{
    add_shader_file(
        "tests/broken", "#version 450\n#include \"lib/numbers.glsl\"\nvoid main() { oops(); }\n");
    graph.add_pass("broken", "tests/broken");
    expect_refused("tests/broken", "1=lib/numbers.glsl");
}

TEST_F(FrameGraphTest, AMissingIncludeNamesTheIncludingLine)
{
    add_shader_file("tests/lost", "#version 450\n#include \"lib/nowhere.glsl\"\nvoid main() { }\n");
    graph.add_pass("lost", "tests/lost");
    expect_refused("tests/lost:2", "'lib/nowhere.glsl' does not exist");
}

}  // namespace
}  // namespace farlight
