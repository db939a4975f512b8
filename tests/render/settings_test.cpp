// RenderSettings: text in and out, refusals, and that every row reaches the picture.
#include "lab/meshes.h"
#include "tests/support/gl_test.h"

#include <nlohmann/json.hpp>
#include <set>

namespace farlight {
namespace {

using nlohmann::json;

TEST(SettingsTest, EveryRowReadsBackWhatItDescribes)
{
    RenderSettings settings;
    for (const json& row : describe_settings(settings, {})) {
        SCOPED_TRACE(row.dump());
        EXPECT_EQ(row["value"], row["default"]);
        EXPECT_FALSE(row["help"].get<std::string>().empty());
        EXPECT_NO_THROW(set_setting(settings, row["key"].get<std::string>(), row["value"]));
        EXPECT_EQ(settings, RenderSettings{});
        for (const char* bound : {"lower", "upper"})
            if (row.contains(bound)) {
                set_setting(settings, row["key"].get<std::string>(), row[bound]);
                set_setting(settings, row["key"].get<std::string>(), row["default"]);
            }
        EXPECT_EQ(settings, RenderSettings{});
    }
}

TEST(SettingsTest, TextAndJsonMeanTheSame)
{
    RenderSettings settings;
    set_setting(settings, "max_depth=7");
    set_setting(settings, "sigma_depth=0.5");
    set_setting(settings, "denoiser=accumulate");
    set_setting(settings, "light_sampling", false);
    EXPECT_EQ(settings.max_depth, 7);
    EXPECT_EQ(settings.sigma_depth, 0.5F);
    EXPECT_EQ(settings.denoiser, Denoiser::kAccumulate);
    EXPECT_FALSE(settings.light_sampling);
}

struct Refusal {
    const char* name;
    const char* key;
    json value;
    const char* message;
};

class SettingsRefuse : public testing::TestWithParam<Refusal> { };

TEST_P(SettingsRefuse, NamingWhatWasFoundAndExpected)
{
    RenderSettings settings;
    try {
        set_setting(settings, GetParam().key, GetParam().value);
        FAIL() << "accepted";
    } catch (const SettingError& error) {
        EXPECT_NE(std::string(error.what()).find(GetParam().message), std::string::npos)
            << error.what();
    }
    EXPECT_EQ(settings, RenderSettings{});
}

INSTANTIATE_TEST_SUITE_P(Settings, SettingsRefuse,
    testing::Values(Refusal{"UnknownKey", "teapot", 1,
                        "setting 'teapot' is unknown, expected one of denoiser, "},
        Refusal{"UnknownChoice", "denoiser", "magic",
            "found \"magic\", expected one of none, accumulate, svgf"},
        Refusal{"TooLarge", "max_depth", 65, "found 65, expected a whole number from 1 to 64"},
        Refusal{"Fraction", "max_depth", 2.5, "found 2.5, expected a whole number from 1 to 64"},
        Refusal{
            "Text", "sigma_depth", "wide", "found \"wide\", expected a number from 0.01 to 100.0"},
        Refusal{"UnknownEffect", "effects", "fog,fgo",
            "lens, specular_signal, antialiasing (no effect is called 'fgo')"},
        Refusal{"EffectOfNoProgram", "effects", "fog,denoising",
            "'denoising' is no part of programs, the setting 'denoiser' controls it"},
        Refusal{"TrailingText", "sigma_depth", "1.5x", "found \"1.5x\", expected a number"},
        Refusal{"Nan", "exposure", "nan", "expected a number from 0.0 to 1000000.0"},
        Refusal{"Infinite", "exposure", "inf", "expected a number from 0.0 to 1000000.0"},
        Refusal{"Null", "exposure", nullptr, "found null, expected a number"},
        Refusal{"Object", "view", json::object(), "found {}, expected one of final, sheet"}),
    [](const auto& test) { return test.param.name; });

/// A value that differs from the default and must change the picture.
json other_value(const json& row)
{
    static const std::map<std::string, json> kChosen{{"svgf_feedback_iteration", 3},
        {"max_depth", 2}, {"roulette_depth", 1}, {"history_max", 2}, {"exposure", 2},
        {"sigma_normal", 4}, {"atrous_iterations", 2}, {"reproject_depth", 0.01},
        {"reproject_normal", 1}, {"svgf_alpha", 0.7}, {"svgf_moments_alpha", 0.7},
        {"svgf_spatial_frames", 1}, {"refine_crossover", 1}, {"resolution_scale", 0.5}};
    if (const auto found = kChosen.find(row["key"]); found != kChosen.end())
        return found->second;
    if (row["type"] == "choice")
        return row["choices"][0] == row["default"] ? row["choices"][1] : row["choices"][0];
    if (row["type"] == "boolean")
        return !row["default"].get<bool>();
    return row["default"].get<double>() + 1;
}

class SettingsReachTheImage : public GlTest { };

/// The test that would have caught a setting which reaches no shader. Those that act outside the
/// picture are named: error_estimate acts on what is said of it, jpeg_quality in the encoder,
/// still_samples on when the still is final, effects on the time that a picture takes, play, time
/// and time_step on which moment is drawn, wipe_* on a view of their own, budget_ms and
/// target_error on other settings.
TEST_F(SettingsReachTheImage, EverySettingChangesTheImage)
{
    const std::set<std::string> elsewhere{"budget_ms", "effects", "error_estimate", "jpeg_quality",
        "play", "still_samples", "target_error", "time", "time_step", "wipe_left", "wipe_position",
        "wipe_right"};
    Scene scene = room_with(bumpy_sphere(24, 12));
    const DeviceScene on_device(scene);
    const auto render = [&](const RenderSettings& settings, bool refine) {
        View view(on_device.shared);
        RenderRequest request = linear_request(scene, {48, 32}, settings);
        request.format = PixelFormat::kRgb8;
        request.refine = refine;
        request.settings.exposure *= 0.2F;  // mid-tones, where a change shows in 8 bits
        RenderedFrame frame;
        for (int i = 0; i < 6; ++i) {
            request.camera.position.x = refine ? 0 : 0.05 * i;
            frame = view.render(request);
        }
        return frame.image.bytes;
    };
    for (const bool refine : {false, true}) {
        const auto usual = render({}, refine);
        for (const json& row : describe_settings({}, {})) {
            const std::string key = row["key"];
            const bool of_resting = key == "refine_crossover" || key == "antialiasing";
            if (elsewhere.contains(key) || of_resting != refine)
                continue;
            RenderSettings settings;
            set_setting(settings, key, other_value(row));
            EXPECT_NE(render(settings, refine), usual) << key << " = " << other_value(row);
        }
    }
}

TEST_F(SettingsReachTheImage, StillSamplesDecidesWhenAPictureIsFinal)
{
    Scene scene = room_with(bumpy_sphere(24, 12));
    const DeviceScene on_device(scene);
    View view(on_device.shared);
    RenderRequest request = linear_request(scene, {16, 16}, {});
    request.settings.still_samples = 6;
    request.settings.samples_per_pixel = 2;
    request.refine = true;
    EXPECT_FALSE(view.render(request).converged);
    EXPECT_FALSE(view.render(request).converged);
    const RenderedFrame third = view.render(request);
    EXPECT_TRUE(third.converged);
    EXPECT_EQ(third.accumulated_samples, 6U);
    request.camera.position.x += 0.1;
    EXPECT_EQ(view.render(request).accumulated_samples, 2U);
}

/// Every debug view draws in both forms, with and without the buffers a denoiser leaves.
TEST_F(SettingsReachTheImage, EveryDebugViewDraws)
{
    Scene scene = room_with(bumpy_sphere(24, 12));
    const DeviceScene on_device(scene);
    for (const std::string_view view_name : kDebugViewNames)
        for (const std::string_view denoiser : kDenoiserNames)
            for (const PixelFormat format : {PixelFormat::kRgb8, PixelFormat::kRgb32f}) {
                View view(on_device.shared);
                RenderRequest request = linear_request(scene, {17, 9}, {});
                request.format = format;
                set_setting(request.settings, "view", view_name);
                set_setting(request.settings, "denoiser", denoiser);
                const RenderedFrame frame = view.render(request);
                EXPECT_EQ(frame.image.bytes.size(), 17U * 9 * bytes_per_pixel(format));
                EXPECT_EQ(frame.bad_values.all(), 0U);
            }
}

TEST_F(SettingsReachTheImage, TheWipeShowsTwoStatesOfThePicture)
{
    Scene scene = room_with(bumpy_sphere(24, 12));
    const DeviceScene on_device(scene);
    const auto render = [&](const std::vector<const char*>& settings) {
        View view(on_device.shared);
        RenderRequest request = linear_request(scene, {16, 9}, {});
        request.refine = true;
        for (const char* setting : settings)
            set_setting(request.settings, setting);
        Image image;
        for (int i = 0; i < 3; ++i)
            image = view.render(request).image;
        return image;
    };
    const Image raw = render({"view=raw_radiance"});
    const Image mean = render({"denoiser=accumulate"});
    const Image denoised = render({"view=wipe", "wipe_right=denoised", "wipe_position=0"});
    const Image wiped =
        render({"view=wipe", "wipe_left=raw", "wipe_right=accumulated", "wipe_position=0.25"});
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(pixel(wiped, x, y), pixel(x < 4 ? raw : mean, x, y)) << x << " " << y;
    EXPECT_NE(denoised.bytes, raw.bytes);
    EXPECT_NE(denoised.bytes, mean.bytes);
    EXPECT_EQ(render({"view=wipe", "wipe_left=denoised", "wipe_position=1"}).bytes, denoised.bytes);
}

/// A buffer that the frame does not have reads zero, never another picture.
TEST_F(SettingsReachTheImage, AViewWithoutItsBufferIsZero)
{
    Scene scene = room_with(bumpy_sphere(24, 12));
    const DeviceScene on_device(scene);
    for (const char* view_name : {"variance", "history_length"})
        for (const char* denoiser : {"none", "svgf"}) {
            View view(on_device.shared);
            RenderRequest request = linear_request(scene, {16, 16}, {});
            set_setting(request.settings, "view", view_name);
            set_setting(request.settings, "denoiser", denoiser);
            view.render(request);
            const Image image = view.render(request).image;
            const bool zero = std::all_of(image.bytes.begin(), image.bytes.end(),
                [](std::byte b) { return b == std::byte{0}; });
            EXPECT_EQ(zero, std::string_view(denoiser) == "none") << view_name;
        }
}

}  // namespace
}  // namespace farlight
