// The command line of farlight-server: what it reads, and how it refuses.
#include "server/flags.h"

#include <gtest/gtest.h>

namespace farlight {
namespace {

std::variant<Flags, int> parse(std::vector<const char*> arguments)
{
    arguments.insert(arguments.begin(), "farlight-server");
    return parse_flags(static_cast<int>(arguments.size()), arguments.data());
}

TEST(Flags, ReadsTheWholeCommandLine)
{
    const auto parsed = parse({"--scene", "a.json", "--device", "software", "--bind", "0.0.0.0",
        "--port", "0", "--size", "640x360", "--set", "samples_per_pixel=4", "--set", "seed=7",
        "--allow-origin", "https://example.org", "--max-clients", "3", "--log-level", "error"});
    ASSERT_TRUE(std::holds_alternative<Flags>(parsed));
    const Flags& flags = std::get<Flags>(parsed);
    EXPECT_EQ(flags.scene, "a.json");
    EXPECT_EQ(flags.renderer.device, "software");
    EXPECT_EQ(flags.renderer.extent, (Extent{640, 360}));
    EXPECT_EQ(flags.renderer.settings.samples_per_pixel, 4);
    EXPECT_EQ(flags.renderer.settings.seed, 7U);
    EXPECT_EQ(flags.stream.bind, "0.0.0.0");
    EXPECT_EQ(flags.stream.port, 0);
    EXPECT_EQ(flags.stream.allowed_origins, std::vector<std::string>{"https://example.org"});
    EXPECT_EQ(flags.stream.max_clients, 3);
    EXPECT_EQ(flags.log_level, spdlog::level::err);
}

TEST(Flags, DefaultsServeThisMachineOnly)
{
    const auto parsed = parse({"--scene", "a.json"});
    ASSERT_TRUE(std::holds_alternative<Flags>(parsed));
    const Flags& flags = std::get<Flags>(parsed);
    EXPECT_EQ(flags.stream.bind, "127.0.0.1");
    EXPECT_EQ(flags.stream.port, 8080);
    EXPECT_EQ(flags.renderer.device, "auto");
    EXPECT_FALSE(flags.renderer.extent.has_value());
}

struct WrongUsage {
    const char* name;
    std::vector<const char*> arguments;
    const char* message;
};

class FlagsRefuse : public testing::TestWithParam<WrongUsage> { };

TEST_P(FlagsRefuse, WithStatusTwoAndAReason)
{
    testing::internal::CaptureStderr();
    const auto parsed = parse(GetParam().arguments);
    const std::string said = testing::internal::GetCapturedStderr();
    ASSERT_TRUE(std::holds_alternative<int>(parsed));
    EXPECT_EQ(std::get<int>(parsed), 2);
    EXPECT_NE(said.find(GetParam().message), std::string::npos) << said;
}

INSTANTIATE_TEST_SUITE_P(WrongUsages, FlagsRefuse,
    testing::Values(WrongUsage{"NoScene", {}, "--scene is required"},
        WrongUsage{"UnknownOption", {"--scene", "a", "--teapot"}, "--teapot"},
        WrongUsage{"BadSize", {"--scene", "a", "--size", "640"}, "found '640'"},
        WrongUsage{"ZeroSize", {"--scene", "a", "--size", "0x10"}, "found '0x10'"},
        WrongUsage{"BadPort", {"--scene", "a", "--port", "70000"}, "--port"},
        WrongUsage{"UnknownSetting", {"--scene", "a", "--set", "teapot=1"}, "teapot"},
        WrongUsage{"BadSetting", {"--scene", "a", "--set", "max_depth=-1"}, "max_depth"},
        WrongUsage{"NoClients", {"--scene", "a", "--max-clients", "0"}, "--max-clients"}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(Flags, HelpAndVersionAreNoErrors)
{
    testing::internal::CaptureStdout();
    EXPECT_EQ(std::get<int>(parse({"--version"})), 0);
    EXPECT_EQ(std::get<int>(parse({"--help"})), 0);
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_NE(said.find("farlight-server " FARLIGHT_VERSION), std::string::npos);
    EXPECT_NE(said.find("--list-devices"), std::string::npos);
}

TEST(ParseExtent, ReadsWidthXHeightAndNothingElse)
{
    EXPECT_EQ(parse_extent("1x2"), (Extent{1, 2}));
    for (const char* wrong :
        {"", "x", "1x", "x2", "1x2x3", "-1x2", "1 x2", "1x2 ", "99999999999x1"})
        EXPECT_EQ(parse_extent(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace farlight
