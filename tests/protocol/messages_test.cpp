// Messages in and out, and how bad ones are refused.
#include "protocol/codec.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using namespace protocol;

struct BadMessage {
    const char* name;
    std::string text;
    ErrorCode code;
    const char* field;
    const char* problem;
};
class DecodeRefuses : public testing::TestWithParam<BadMessage> { };

TEST_P(DecodeRefuses, NamingFieldAndProblem)
{
    const auto decoded = decode_client_message(GetParam().text);
    const auto* error = std::get_if<DecodeError>(&decoded);
    ASSERT_NE(error, nullptr);
    EXPECT_EQ(name_of(error->code), name_of(GetParam().code));
    EXPECT_EQ(error->field, GetParam().field);
    EXPECT_EQ(error->problem, GetParam().problem);
}

/// A camera message with one field replaced or, with an empty value, left out.
std::string camera_with(const std::string& field, const std::string& value)
{
    std::map<std::string, std::string> fields{{"sequence", "1"}, {"position", "[0,0,5]"},
        {"target", "[0,0,0]"}, {"up", "[0,1,0]"}, {"vertical_fov_degrees", "45"}};
    fields[field] = value;
    std::string text = R"({"type":"camera")";
    for (const auto& [key, written] : fields)
        if (!written.empty())
            text.append(",\"").append(key).append("\":").append(written);
    return text + "}";
}

std::string nested(int depth)
{
    return R"({"type":"ping","t":1,"x":)" + std::string(depth, '[') + std::string(depth, ']') + "}";
}

using enum ErrorCode;

INSTANTIATE_TEST_SUITE_P(Messages, DecodeRefuses,
    testing::Values(BadMessage{"Empty", "", kNotJson, "", "is not JSON"},
        BadMessage{"NotJson", "camera", kNotJson, "", "is not JSON"},
        BadMessage{"NotAnObject", "[1]", kNotJson, "", "is not a JSON object"},
        BadMessage{"TwoObjects", "{}{}", kNotJson, "", "is not JSON"},
        BadMessage{"BadUtf8", "{\"type\":\"\xFF\"}", kNotJson, "", "is not JSON"},
        BadMessage{"NanIsNotJson", camera_with("vertical_fov_degrees", "NaN"), kNotJson, "",
            "is not JSON"},
        BadMessage{"NoType", "{}", kMissingField, "type", "is missing"},
        BadMessage{"TypeNotAString", R"({"type":1})", kWrongType, "type",
            "has the wrong type, expected a string"},
        BadMessage{
            "UnknownType", R"({"type":"teapot"})", kUnknownType, "type", "is unknown: teapot"},
        BadMessage{
            "ServersType", R"({"type":"welcome"})", kUnknownType, "type", "is unknown: welcome"},
        BadMessage{
            "MissingField", camera_with("target", ""), kMissingField, "target", "is missing"},
        BadMessage{"WrongType", R"({"type":"ack","frame_id":[]})", kWrongType, "frame_id",
            "has the wrong type, expected a whole number"},
        BadMessage{"Null", R"({"type":"ack","frame_id":null})", kWrongType, "frame_id",
            "has the wrong type, expected a whole number"},
        BadMessage{"Fraction", R"({"type":"ack","frame_id":1.5})", kWrongType, "frame_id",
            "has the wrong type, expected a whole number"},
        BadMessage{"Negative", R"({"type":"ack","frame_id":-1})", kOutOfRange, "frame_id",
            "is -1, expected 0 to 4294967295"},
        BadMessage{"TooBigForU32", R"({"type":"ack","frame_id":4294967296})", kOutOfRange,
            "frame_id", "is 4294967296, expected 0 to 4294967295"},
        BadMessage{"TooBigForU64", R"({"type":"ack","frame_id":18446744073709551616})", kWrongType,
            "frame_id", "has the wrong type, expected a whole number"},
        BadMessage{"Infinite", camera_with("vertical_fov_degrees", "1e999"), kNotFinite, "",
            "holds a number that is not finite"},
        BadMessage{"FovTooWide", camera_with("vertical_fov_degrees", "180"), kOutOfRange,
            "vertical_fov_degrees", "is 180, expected 0.001 to 179"},
        BadMessage{"TooFarAway", camera_with("position", "[0,1e13,0]"), kOutOfRange, "position.1",
            "is 10000000000000.0, expected -1000000000000 to 1000000000000"},
        BadMessage{"ShortArray", camera_with("position", "[0,1]"), kWrongType, "position",
            "has the wrong type, expected an array of 3 numbers"},
        BadMessage{"StringInArray", camera_with("up", R"([0,"1",0])"), kWrongType, "up.1",
            "has the wrong type, expected a number"},
        BadMessage{"LooksNowhere", camera_with("target", "[0,0,5]"), kOutOfRange, "target",
            "equals position, expected another point"},
        BadMessage{"NoUp", camera_with("up", "[0,0,0]"), kOutOfRange, "up",
            "is zero, expected a direction"},
        BadMessage{"CutIsNotABoolean", camera_with("cut", "1"), kWrongType, "cut",
            "has the wrong type, expected true or false"},
        BadMessage{"UnknownFormat", R"({"type":"format","format":"gif"})", kOutOfRange, "format",
            "is 'gif', expected one of jpeg420, jpeg444, png, raw"},
        BadMessage{"ZeroSize", R"({"type":"resize","width":0,"height":9})", kOutOfRange, "width",
            "is 0, expected 1 to 65535"},
        BadMessage{"StructuredSetting", R"({"type":"set","key":"seed","value":[1]})", kWrongType,
            "value", "has the wrong type, expected a string, number or boolean"},
        BadMessage{"LongKey", R"({"type":"set","value":1,"key":")" + std::string(65, 'k') + "\"}",
            kTooLarge, "key", "has 65 bytes, expected at most 64"},
        BadMessage{"TooDeep", nested(16), kTooDeep, "", "nests deeper than 16 levels"},
        BadMessage{
            "AbsurdlyDeep", std::string(16000, '['), kTooDeep, "", "nests deeper than 16 levels"},
        BadMessage{"TooLarge", std::string(16385, ' '), kTooLarge, "",
            "has 16385 bytes, expected at most 16384"}),
    [](const auto& tested) { return tested.param.name; });

TEST(Decode, UnknownFieldsAreIgnoredAndBracketsInStringsAreNoDepth)
{
    const auto decoded = decode_client_message(
        R"({"type":"ping","t":2,"note":"\"[[[[[[[[[[[[","more":{"a":[[[[[1]]]]]}})");
    const auto* message = std::get_if<ClientMessage>(&decoded);
    ASSERT_NE(message, nullptr);
    EXPECT_EQ(std::get<Ping>(*message).t, 2);
}

TEST(Decode, AbsentOptionalFieldsTakeTheirDefaults)
{
    const auto decoded = decode_client_message(R"({"type":"hello","client":"x"})");
    const auto* message = std::get_if<ClientMessage>(&decoded);
    ASSERT_NE(message, nullptr);
    EXPECT_EQ(std::get<Hello>(*message), Hello{.client = "x"});
}

TEST(Decode, NumbersSurviveARoundTripExactly)
{
    Camera camera{.sequence = 4294967295U};
    camera.pose.position = {0.1, -1.0 / 3, 1e-300};
    camera.pose.target = {123456789.123456789, 5e11, -0.0};
    const auto decoded = decode_client_message(encode(ClientMessage(camera)));
    const auto* message = std::get_if<ClientMessage>(&decoded);
    ASSERT_NE(message, nullptr);
    EXPECT_EQ(std::get<Camera>(*message), camera);
}

TEST(Encode, StringsThatAreNotUtf8StillMakeJson)
{
    const auto text = encode(ServerMessage(ServerBye{.reason = "caf\xE9", .reconnect_ms = 1}));
    const auto decoded = decode_server_message(text);
    EXPECT_TRUE(std::holds_alternative<ServerMessage>(decoded)) << text;
}

TEST(DecodeError, BecomesAnErrorMessageThatNamesTheField)
{
    const auto decoded = decode_client_message(R"({"type":"resize","width":"a","height":1})");
    const Error error = to_error_message(std::get<DecodeError>(decoded));
    EXPECT_EQ(error.code, ErrorCode::kWrongType);
    EXPECT_EQ(error.field, "width");
    EXPECT_EQ(error.message, "width has the wrong type, expected a whole number");
    EXPECT_FALSE(error.fatal);
}

}  // namespace
}  // namespace farlight
