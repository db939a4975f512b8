// The smaller parts of a sweep: journal, enlarged pictures, colours, references, patches of scenes.
#include "client/accuracy/effect_costs.h"
#include "client/accuracy/errors.h"
#include "client/accuracy/gallery.h"
#include "client/accuracy/journal.h"
#include "client/accuracy/moving_light.h"
#include "client/accuracy/picture_text.h"
#include "client/accuracy/progress.h"
#include "client/accuracy/response.h"
#include "client/accuracy/times.h"

#include <gmock/gmock.h>
#include <random>

namespace farlight {
namespace {

using namespace client;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

class JournalTest : public testing::Test {
protected:
    JournalTest() { std::filesystem::remove(file); }
    ~JournalTest() override { std::filesystem::remove(file); }

    std::filesystem::path file = std::filesystem::path(testing::TempDir())
        / ("farlight_journal_" + std::to_string(::getpid()));
    json key{{"scene", "a"}, {"size", {16, 9}}};
};

TEST_F(JournalTest, WhatWasMeasuredIsThereTheNextTime)
{
    {
        Journal journal(file, key);
        EXPECT_TRUE(journal.fresh());
        EXPECT_EQ(journal.finding(), "");
        journal.add("error a", 1);
        journal.add("error b", {{"relmse", 0.5}});
        journal.add("error a", 2);
    }
    std::ofstream(file, std::ios::app) << "{\"name\": \"error c\", \"val";  // killed while writing
    const Journal journal(file, key);
    EXPECT_FALSE(journal.fresh());
    EXPECT_THAT(journal.finding(), HasSubstr("2 measurements are done"));
    EXPECT_EQ(*journal.find("error a"), 2);
    EXPECT_EQ(journal.find("error b")->at("relmse"), 0.5);
    EXPECT_EQ(journal.find("error c"), nullptr);
}

TEST_F(JournalTest, AnotherKeyStartsAnewAndSaysWhatChanged)
{
    Journal(file, key).add("error a", 1);
    key["size"] = {32, 18};
    {
        const Journal journal(file, key);
        EXPECT_TRUE(journal.fresh());
        EXPECT_THAT(journal.finding(), HasSubstr("another size: everything is measured anew"));
        EXPECT_EQ(journal.find("error a"), nullptr);
    }
    EXPECT_FALSE(Journal(file, key).fresh());  // begun with the new key
}

TEST_F(JournalTest, ALineAfterABrokenOneIsKept)
{
    Journal(file, key).add("error a", 1);
    std::ofstream(file, std::ios::app) << "{\"name\": \"err";
    Journal(file, key).add("error b", 2);
    EXPECT_NE(Journal(file, key).find("error b"), nullptr);
}

TEST_F(JournalTest, AnotherFileIsNoJournal)
{
    std::ofstream(file) << "notes\n";
    EXPECT_THAT(Journal(file, key).finding(), HasSubstr("no journal"));
}

class NamedFilesTest : public testing::Test {
protected:
    NamedFilesTest() { std::filesystem::create_directories(folder); }
    ~NamedFilesTest() override { std::filesystem::remove_all(folder); }

    void write(const std::string& name, const std::string& content) const
    {
        std::ofstream(folder / name, std::ios::binary) << content;
    }
    /// Changes the file's time, and whether that is seen.
    bool sees_change_of(const std::string& name) const
    {
        const json before = named_files(folder / "scene.json");
        EXPECT_EQ(named_files(folder / "scene.json"), before);
        const auto changed = std::filesystem::last_write_time(folder / name);
        std::filesystem::last_write_time(folder / name, changed + std::chrono::seconds(2));
        return named_files(folder / "scene.json") != before;
    }

    std::filesystem::path folder = std::filesystem::path(testing::TempDir())
        / ("farlight_named_" + std::to_string(::getpid()));
};

TEST_F(NamedFilesTest, OfASceneAreInTheKey)
{
    write("a.png", "1234");
    write("scene.json", R"({"name": "a room", "textures": [{"file": "a.png", "scale": 2}]})");
    const json files = named_files(folder / "scene.json");
    ASSERT_EQ(files.size(), 1U) << files;
    EXPECT_EQ(files[0][1], 4);
    EXPECT_TRUE(sees_change_of("a.png"));
    write("scene.json", "no JSON");
    EXPECT_TRUE(named_files(folder / "scene.json").empty());
}

TEST_F(NamedFilesTest, OfMeshFilesAreInTheKeyToo)
{
    const std::string document =
        R"({"images": [{"uri": "red%20brick.png"}], "buffers": [{"uri": "room.bin"}]})";
    write("red brick.png", "1");
    write("room.bin", "2");
    write("room.gltf", document);
    write("scene.json", R"({"objects": [{"mesh": {"file": "room.gltf"}}]})");
    EXPECT_TRUE(sees_change_of("red brick.png"));
    EXPECT_TRUE(sees_change_of("room.bin"));
    EXPECT_TRUE(sees_change_of("room.gltf"));
    const auto length = static_cast<char>(document.size());
    write("room.glb",
        std::string("glTF\2\0\0\0\0\0\0\0", 12) + length + std::string("\0\0\0JSON", 7) + document
            + "binary");
    write("scene.json", R"({"objects": [{"mesh": {"file": "room.glb"}}]})");
    EXPECT_TRUE(sees_change_of("room.bin"));
    EXPECT_EQ(named_files(folder / "room.glb").size(), 2U);
    write("scene.json", R"({"a": "scene.json", "b": "room.gltf"})");  // itself: no end of it
    EXPECT_EQ(named_files(folder / "scene.json").size(), 4U);
}

TEST(Enlarged, KeepsAConstantAndInterpolatesBetweenCentres)
{
    const Picture flat{.width = 3, .height = 2, .linear = std::vector<float>(18, 0.3F)};
    for (const float value : enlarged(flat, 7, 5).linear)
        EXPECT_FLOAT_EQ(value, 0.3F);
    const Picture two{.width = 2, .height = 1, .linear = {0, 0, 0, 1, 1, 1}};
    const Picture four = enlarged(two, 4, 1);
    std::vector<float> red;
    for (std::size_t i = 0; i < four.linear.size(); i += 3)
        red.push_back(four.linear[i]);
    EXPECT_THAT(red, ElementsAre(0.0F, 0.25F, 0.75F, 1.0F));
}

TEST(PictureText, Base64IsAsTheStandardSays)  // RFC 4648, section 10
{
    const auto encoded = [](const std::string& text) {
        return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
    };
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(Gallery, SpreadKeepsBothEnds)
{
    EXPECT_THAT(spread(9, 4), ElementsAre(0U, 2U, 5U, 8U));
    EXPECT_THAT(spread(2, 4), ElementsAre(0U, 1U));
    EXPECT_THAT(spread(0, 4), ElementsAre());
}

TEST(Reference, VarianceIsThatOfTheMean)
{
    std::vector<Picture> batches;
    for (const float value : {1.0F, 2.0F, 3.0F})
        batches.push_back({.width = 1, .height = 1, .linear = {value, 1, 0}});
    const ReferencePicture reference = reference_of(batches);
    EXPECT_THAT(reference.mean, ElementsAre(2, 1, 0));
    EXPECT_FLOAT_EQ(reference.variance[0], 1.0F / 3);  // sample variance 1, 3 batches
    EXPECT_FLOAT_EQ(reference.variance[1], 0);
    EXPECT_NEAR(reference.own_relmse(), (1.0 / 3 / 4.01) / 3, 1e-7);  // variance in float
}

TEST(Reference, PixelsWithoutSurfaceOrChanceDoNotCount)
{
    // Four pixels: a surface, an even sky, a sky whose air is left to chance, a black surface.
    std::vector<Picture> batches;
    for (const float value : {1.0F, 2.0F})
        batches.push_back({.width = 4,
            .height = 1,
            .linear = {value, 1, 0, 0.3F, 0.4F, 0.5F, 1, value, 1, 0, 0, 0}});
    const std::vector<float> depth{5, 5, 5, -1, -1, -1, 0, 0, 0, 2, 2, 2};
    const ReferencePicture reference = reference_of(batches, depth);
    EXPECT_THAT(reference.counts, ElementsAre(1, 0, 1, 1));
    EXPECT_EQ(reference.counted_share(), 0.75);
    EXPECT_NEAR(reference.own_relmse(), 2 * (0.25 / 2.26) / 9, 1e-7);
    EXPECT_EQ(reference_of(batches).counted_share(), 1);
    // Where no pixel would count, all do.
    const Picture sky{.width = 1, .height = 1, .linear = {1, 1, 1}};
    EXPECT_EQ(reference_of({sky, sky}, std::vector<float>{0, 0, 0}).counted_share(), 1);
}

/// A grey gradient with noise in `size`; around it a border of `margin` pixels that is black.
struct Framed {
    ImageSize size;
    int margin;

    Picture draw(std::uint32_t seed, float noise) const
    {
        std::mt19937 random(seed);
        std::normal_distribution<float> normal;
        Picture picture{.width = size.width + 2 * margin, .height = size.height + 2 * margin};
        for (int y = -margin; y < size.height + margin; ++y)
            for (int x = -margin; x < size.width + margin; ++x)
                for (int c = 0; c < 3; ++c)
                    picture.linear.push_back(inside(x, y)
                            ? 0.2F + 0.01F * static_cast<float>(x + y) + noise * normal(random)
                            : 0.0F);
        return picture;
    }
    std::vector<float> depth() const
    {
        std::vector<float> depth;
        for (int y = -margin; y < size.height + margin; ++y)
            for (int x = -margin; x < size.width + margin; ++x)
                depth.insert(depth.end(), 3, inside(x, y) ? 4.0F : 0.0F);
        return depth;
    }
    bool inside(int x, int y) const
    {
        return x >= 0 && x < size.width && y >= 0 && y < size.height;
    }
    json error() const
    {
        std::vector<Picture> batches;
        for (std::uint32_t seed = 100; seed < 116; ++seed)
            batches.push_back(draw(seed, 0.01F));
        std::vector<std::vector<float>> pictures;
        for (std::uint32_t seed = 1; seed <= 5; ++seed)
            pictures.push_back(draw(seed, 0.1F).linear);
        return measured_error(pictures, reference_of(batches, depth()), 2);
    }
};

TEST(MeasuredError, IsNotDilutedByABlackBorder)
{
    const json bare = Framed{{32, 24}, 0}.error();
    const json framed = Framed{{32, 24}, 12}.error();
    for (const char* name : {"relmse", "bias", "variance"})
        for (const char* part : {"value", "lower", "upper"})
            EXPECT_DOUBLE_EQ(framed[name][part].get<double>(), bare[name][part].get<double>())
                << name << " " << part;
    for (const char* name : {"relmse999", "mse", "fireflies"})
        EXPECT_DOUBLE_EQ(framed[name].get<double>(), bare[name].get<double>()) << name;
    // Pixels at the edge see black beyond it rather than themselves repeated, in both pictures.
    EXPECT_NEAR(
        framed["flip"].get<double>(), bare["flip"].get<double>(), 0.1 * bare["flip"].get<double>());
}

TEST(MeasuredError, RefusesNanWhereNothingCounts)
{
    ReferencePicture reference{.size = {2, 1},
        .mean = std::vector<float>(6, 0.5F),
        .variance = std::vector<float>(6, 0.0F),
        .counts = {1, 0}};
    std::vector<float> picture(6, 0.25F);
    EXPECT_NO_THROW(measured_error({picture, picture, picture}, reference, 1));
    picture.back() = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(measured_error({picture, picture, picture}, reference, 1), MetricError);
}

TEST(Reference, OnlyItsOwnFilesAreRemoved)
{
    const auto folder = std::filesystem::path(testing::TempDir())
        / ("farlight_batches_" + std::to_string(::getpid()));
    const std::vector<const char*> others{"batch_1.png", "batch_two.pfm", "photo.pfm", "notes"};
    const std::vector<const char*> ours{"batch_0.pfm", "batch_15.pfm", "unfinished.pfm"};
    std::filesystem::create_directories(folder / "batch_7.pfm");
    for (const auto& names : {others, ours})
        for (const char* name : names)
            std::ofstream(folder / name) << "x";
    remove_batches(folder);
    for (const char* name : others)
        EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
    for (const char* name : ours)
        EXPECT_FALSE(std::filesystem::exists(folder / name)) << name;
    EXPECT_TRUE(std::filesystem::exists(folder / "batch_7.pfm"));  // a folder
    std::filesystem::remove_all(folder);
    remove_batches(folder);  // none there: nothing to do
}

TEST(MeasuredError, OfABlackSceneIsLimitedByTheReference)
{
    const std::vector<float> black(48, 0.0F);
    const ReferencePicture reference{
        .size = {4, 4}, .mean = black, .variance = black, .samples = 32};
    const json error = measured_error({black, black, black}, reference, 1);
    EXPECT_EQ(error["relmse"]["value"], 0.0);
    EXPECT_EQ(error["reference_limited"], true);
    const std::vector<float> grey(black.size(), 0.5F);
    EXPECT_EQ(measured_error({grey, grey, grey}, reference, 1)["reference_limited"], false);
}

TEST(Response, DimsEveryLightThatIsNamed)
{
    const json document = json::parse(R"({
        "materials": {"lamp": {"emission": [4, 8, 0]}, "wall": {"albedo": [1, 1, 1]}},
        "lights": {"bulb": {"intensity": [2, 2, 2], "point": {}}},
        "background": [0.4, 0.4, 0.4], "environment": {"file": "x.hdr"}})");
    const json patch = dimming(document).patch;
    EXPECT_EQ(patch["materials"]["lamp"]["emission"], json({1, 2, 0}));
    EXPECT_FALSE(patch["materials"].contains("wall"));
    EXPECT_EQ(patch["lights"]["bulb"]["intensity"], json({0.5, 0.5, 0.5}));
    EXPECT_EQ(patch["background"], json({0.1, 0.1, 0.1}));
    EXPECT_EQ(patch["environment"]["scale"], json({0.25, 0.25, 0.25}));
    EXPECT_TRUE(dimming(json()).patch.is_null());
    EXPECT_TRUE(dimming(json::parse(R"({"objects": []})")).patch.is_null());
}

TEST(Motion, MovesEveryLampThatHasAPlace)
{
    const json document = json::parse(R"({
        "materials": {"lamp": {"emission": [4, 8, 0]}, "off": {"emission": [0, 0, 0]}},
        "objects": [
            {"material": "lamp", "quad": {"corner": [0, 5, 0], "edge_u": [2, 0, 0], "edge_v": [0, 0, 1]}},
            {"name": "ball", "material": "lamp", "sphere": {"center": [4, 0, 0], "radius": 0.5}},
            {"name": "dark", "material": "off", "sphere": {"center": [0, 0, 0], "radius": 1}}],
        "lights": {"bulb": {"point": {"position": [0, 8, 0]}}, "sun": {"directional": {}}},
        "timeline": [{"at": 1, "light": "sun", "on": false}]})");
    const LightMotion motion = motion_of_lamps(document, {0, 0, 0}, 8);
    const json& events = motion.patch["timeline"];
    ASSERT_EQ(events.size(), 4U) << events;
    EXPECT_EQ(events[0], document["timeline"][0]);
    EXPECT_EQ(events[1]["object"], "lamp, object 1");
    EXPECT_EQ(motion.patch["objects"][0]["name"], "lamp, object 1");
    EXPECT_EQ(motion.patch["objects"].size(), 3U);
    EXPECT_EQ(events[1]["move"], json({2, -1, 0}));  // its width along itself, half of it off
    EXPECT_EQ(events[1]["over"], 0.25);
    EXPECT_EQ(events[2]["move"], json({-1, 0, 0}));
    EXPECT_EQ(events[3]["move"], json({0, -2, 0}));
    EXPECT_TRUE(motion_of_lamps(json(), {0, 0, 0}, 8).patch.is_null());
    EXPECT_TRUE(motion_of_lamps(json::parse(R"({"objects": []})"), {}, 8).patch.is_null());
    // Objects by name: nothing is to be named.
    const json named = json::parse(R"({"materials": {"lamp": {"emission": [1, 1, 1]}}, "objects":
        {"a": {"material": "lamp", "disk": {"center": [0, 0, 0], "normal": [0, -1, 0], "radius": 1}}}})");
    const json patch = motion_of_lamps(named, {0, 0, 0}, 8).patch;
    EXPECT_EQ(patch["timeline"][0]["object"], "a");
    EXPECT_FALSE(patch.contains("objects"));
}

TEST(EffectCosts, PatchesTakeAnEffectOut)
{
    const json document = json::parse(R"({"fog": {"name": "haze"},
        "materials": {"a": {"normal_texture": "n.png"}, "b": {}}})");
    EXPECT_EQ(removal_of("fog", document), json::parse(R"({"fog": null})"));
    EXPECT_EQ(removal_of("normal_maps", document),
        json::parse(R"({"materials": {"a": {"normal_texture": null}}})"));
    EXPECT_TRUE(removal_of("clearcoat", document).is_null());
    EXPECT_TRUE(removal_of("triangles", document).is_null());
    EXPECT_TRUE(removal_of("fog", json()).is_null());
}

TEST(EffectCosts, NoiseIsVarianceRelativeToTheMean)
{
    EXPECT_NEAR(relative_noise({{1, 1, 1}, {3, 1, 1}}), (2 / 4.01) / 3, 1e-7);
    const std::vector<std::uint8_t> first{1, 0};
    EXPECT_NEAR(
        relative_noise({{1, 1, 1, 0, 0, 0}, {3, 1, 1, 0, 0, 0}}, first), (2 / 4.01) / 3, 1e-7);
}

TEST(FrameTimes, AreKeptThroughTheJournal)
{
    protocol::FrameHeader header;
    header.passes = {{"gbuffer", 1.5F}, {"path_trace", 2.5F}};
    header.encode_us = 500;
    FrameTimes times;
    times.add(header);
    header.frame_us = 4100;
    times.add(header);
    const FrameTimes again = frame_times_of(to_json(times));
    EXPECT_THAT(again.passes_sum, ElementsAre(4, 4));
    EXPECT_THAT(again.whole, ElementsAre(testing::DoubleEq(4.1)));  // 0 means: not told
    EXPECT_EQ(summary_of(again)["passes"][1]["name"], "path_trace");
    EXPECT_EQ(summary_of(again)["ms"]["value"], 4.0);
    EXPECT_DOUBLE_EQ(summary_of(again)["encode_ms"].get<double>(), 0.5);
}

TEST(Duration, IsReadable)
{
    EXPECT_EQ(duration_text(59.4), "59 s");
    EXPECT_EQ(duration_text(80), "1 min 20 s");
    EXPECT_EQ(duration_text(7260), "2 h 1 min");
}

}  // namespace
}  // namespace farlight
