// PROTOCOL.md says what the code does: examples decode and encode, tables equal the each_field
// lists.
#include "protocol/frame_header.h"
#include "protocol/messages.h"
#include "tests/protocol/document.h"

#include <algorithm>
#include <cstdlib>
#include <gmock/gmock.h>
#include <set>
#include <sstream>

namespace farlight {
namespace {

using namespace protocol;
using Json = nlohmann::json;
using testing::ElementsAreArray;

const ProtocolDocument& document()
{
    static const ProtocolDocument page = read_protocol_document();
    return page;
}

/// What is in `subset` is in `whole`, field for field.
void expect_contains(const Json& whole, const Json& subset, const std::string& where)
{
    for (const auto& [key, value] : subset.items()) {
        ASSERT_TRUE(whole.contains(key)) << where << "/" << key;
        if (value.is_object())
            expect_contains(whole[key], value, std::string(where).append("/").append(key));
        else
            EXPECT_EQ(whole[key], value) << where << "/" << key;
    }
}

template <typename Variant>
void check_examples(const std::string& info, auto&& decode, std::size_t message_types)
{
    std::set<std::size_t> seen;
    for (const std::string& text : document().examples.at(info)) {
        const Decoded<Variant> decoded = decode(text);
        const auto* message = std::get_if<Variant>(&decoded);
        ASSERT_NE(message, nullptr) << text << to_string(*std::get_if<DecodeError>(&decoded));
        seen.insert(message->index());
        expect_contains(Json::parse(encode(*message)), Json::parse(text), info);
        EXPECT_EQ(std::get<Variant>(decode(encode(*message))), *message) << text;
    }
    EXPECT_EQ(seen.size(), message_types) << "every message type needs an example";
}

TEST(ProtocolDocument, EveryClientExampleDecodesAndEncodes)
{
    check_examples<ClientMessage>(
        "json client", decode_client_message, std::variant_size_v<ClientMessage>);
}

TEST(ProtocolDocument, EveryServerExampleDecodesAndEncodes)
{
    check_examples<ServerMessage>(
        "json server", decode_server_message, std::variant_size_v<ServerMessage>);
}

// ---------------------------------------------------------------- field tables

template <typename T> struct Wire {
    static std::string type()
    {
        if constexpr (std::is_same_v<T, bool>)
            return "boolean";
        else if constexpr (std::is_same_v<T, Json>)
            return "any";
        else if constexpr (std::is_same_v<T, std::string> || std::is_enum_v<T>)
            return "string";
        else if constexpr (std::is_integral_v<T>)
            return "integer";
        else if constexpr (std::is_floating_point_v<T>)
            return "number";
        else
            return "object";
    }
};
template <typename T> struct Wire<std::optional<T>> : Wire<T> {
};
template <typename T> struct Wire<std::vector<T>> {
    static std::string type() { return Wire<T>::type() + "[]"; }
};
template <typename T, std::size_t kCount> struct Wire<std::array<T, kCount>> {
    static std::string type() { return Wire<T>::type() + "[" + std::to_string(kCount) + "]"; }
};

template <typename T> constexpr bool kIsOptional = false;
template <typename T> constexpr bool kIsOptional<std::optional<T>> = true;

template <typename T> std::string range_text(const Rule& rule)
{
    if constexpr (std::is_enum_v<T>) {
        std::string names;
        for (const std::string_view name : names_of(T{}))
            names += (names.empty() ? "" : ", ") + std::string(name);
        return names;
    } else {
        const auto plain = [](double value) {
            std::ostringstream text;
            text.precision(12);
            text << value;
            std::string digits = text.str();
            for (const char* padding : {"e+0", "e+"})
                if (const auto at = digits.find(padding); at != std::string::npos)
                    digits.replace(at, std::string(padding).size(), "e");
            return digits;
        };
        Rule shown = rule;
        if (std::is_same_v<T, std::uint32_t> && std::isinf(rule.upper)) {
            shown.lower = 0;
            shown.upper = std::numeric_limits<std::uint32_t>::max();
        }
        if (std::is_same_v<T, std::string> && rule.longest != Rule{}.longest)
            return "at most " + std::to_string(rule.longest) + " bytes";
        return std::isinf(shown.upper) ? "" : plain(shown.lower) + " to " + plain(shown.upper);
    }
}

/// The table a message's page section must show, without the columns meant for people.
template <typename Message> std::vector<std::string> rows_in_code()
{
    std::vector<std::string> rows;
    Message defaults;
    Message::each_field(defaults, [&](std::string_view name, auto& member, const Rule& rule) {
        using Member = std::remove_cvref_t<decltype(member)>;
        const bool required = rule.required && !kIsOptional<Member>;
        std::string range;
        if constexpr (kIsOptional<Member>)
            range = range_text<typename Member::value_type>(rule);
        else
            range = range_text<Member>(rule);
        rows.push_back("`" + std::string(name) + "` " + Wire<Member>::type() + " (" + range + ") "
            + (required ? "yes" : "no"));
    });
    return rows;
}

std::vector<std::string> rows_in_page(const std::string& table)
{
    std::vector<std::string> rows;
    const auto found = document().tables.find(table);
    if (found == document().tables.end())
        return rows;
    for (std::size_t i = 2; i < found->second.size(); ++i) {
        const auto& cells = found->second[i];
        if (cells.size()
            == 6)  // longer or shorter rows belong to other tables below the same heading
            rows.push_back(cells[0] + " " + cells[1] + " (" + cells[2] + ") " + cells[3]);
    }
    return rows;
}

TEST(ProtocolDocument, FieldTablesEqualTheCode)
{
    EXPECT_THAT(rows_in_page("3/hello"), ElementsAreArray(rows_in_code<Hello>()));
    EXPECT_THAT(rows_in_page("3/camera"), ElementsAreArray(rows_in_code<Camera>()));
    EXPECT_THAT(rows_in_page("3/set"), ElementsAreArray(rows_in_code<Set>()));
    EXPECT_THAT(rows_in_page("3/resize"), ElementsAreArray(rows_in_code<Resize>()));
    EXPECT_THAT(rows_in_page("3/format"), ElementsAreArray(rows_in_code<SetFormat>()));
    EXPECT_THAT(rows_in_page("3/ack"), ElementsAreArray(rows_in_code<Ack>()));
    EXPECT_THAT(rows_in_page("3/ping"), ElementsAreArray(rows_in_code<Ping>()));
    EXPECT_THAT(rows_in_page("3/edit"), ElementsAreArray(rows_in_code<Edit>()));
    EXPECT_THAT(rows_in_page("3/inspect"), ElementsAreArray(rows_in_code<Inspect>()));
    EXPECT_THAT(rows_in_page("3/bye"), ElementsAreArray(rows_in_code<ClientBye>()));
    EXPECT_THAT(rows_in_page("4/welcome"), ElementsAreArray(rows_in_code<Welcome>()));
    EXPECT_THAT(rows_in_page("4/scene"), ElementsAreArray(rows_in_code<SceneSummary>()));
    EXPECT_THAT(rows_in_page("4/bounds"), ElementsAreArray(rows_in_code<BoundingBox>()));
    EXPECT_THAT(rows_in_page("4/pose"), ElementsAreArray(rows_in_code<Pose>()));
    EXPECT_THAT(rows_in_page("4/keyframe"), ElementsAreArray(rows_in_code<Keyframe>()));
    EXPECT_THAT(rows_in_page("4/limits"), ElementsAreArray(rows_in_code<Limits>()));
    EXPECT_THAT(rows_in_page("4/state"), ElementsAreArray(rows_in_code<State>()));
    EXPECT_THAT(rows_in_page("4/error"), ElementsAreArray(rows_in_code<Error>()));
    EXPECT_THAT(rows_in_page("4/scene_changed"), ElementsAreArray(rows_in_code<SceneChanged>()));
    EXPECT_THAT(rows_in_page("4/inspection"), ElementsAreArray(rows_in_code<Inspection>()));
    EXPECT_THAT(rows_in_page("4/effect"), ElementsAreArray(rows_in_code<CalledEffect>()));
    EXPECT_THAT(rows_in_page("4/constant"), ElementsAreArray(rows_in_code<ProgramConstant>()));
    EXPECT_THAT(rows_in_page("4/memory"), ElementsAreArray(rows_in_code<MemoryUse>()));
    EXPECT_THAT(rows_in_page("4/frontier"), ElementsAreArray(rows_in_code<Frontier>()));
    EXPECT_THAT(rows_in_page("4/point"), ElementsAreArray(rows_in_code<FrontierPoint>()));
    EXPECT_THAT(rows_in_page("4/pong"), ElementsAreArray(rows_in_code<Pong>()));
    EXPECT_THAT(rows_in_page("4/bye"), ElementsAreArray(rows_in_code<ServerBye>()));
}

TEST(ProtocolDocument, HelloDefaultsEqualTheCode)
{
    const Json defaults = Json::parse(encode(Hello{}));
    for (std::size_t i = 2; i < document().tables.at("3/hello").size(); ++i) {
        const auto& cells = document().tables.at("3/hello")[i];
        const std::string key = cells[0].substr(1, cells[0].size() - 2);
        if (!cells[4].starts_with('`'))
            continue;
        EXPECT_EQ(cells[4], "`" + defaults.at(key).dump() + "`") << key;
    }
}

TEST(ProtocolDocument, EveryErrorCodeIsExplained)
{
    std::string explained;
    for (const auto& cells : document().tables.at("4/error"))
        if (cells.size() == 3)
            explained += cells[0] + " ";
    for (const std::string_view code : kErrorCodeNames)
        EXPECT_NE(explained.find("`" + std::string(code) + "`"), std::string::npos) << code;
}

// ---------------------------------------------------------------- frame header

TEST(ProtocolDocument, FrameTableEqualsTheCode)
{
    std::map<std::string, std::pair<std::size_t, std::string>> page;
    for (const auto& cells : document().tables.at("5"))
        if (cells.size() == 4 && cells[2].starts_with('`'))
            page[cells[2]] = {std::strtoul(cells[0].c_str(), nullptr, 10), cells[1]};

    FrameHeader header;
    FrameHeader::each_field(header, [&](std::size_t at, std::string_view name, auto& member) {
        using Member = std::remove_cvref_t<decltype(member)>;
        const std::string type = std::string(std::is_floating_point_v<Member> ? "f" : "u")
            + std::to_string(sizeof(Member) * 8);
        EXPECT_EQ(page["`" + std::string(name) + "`"], std::pair(at, type)) << name;
    });
    EXPECT_EQ(page["`magic`"], std::pair(std::size_t{0}, std::string("u8[4]")));
    EXPECT_EQ(page.size(), 6 + 33U) << "6 derived fields and those of each_field";
}

TEST(ProtocolDocument, FlagTableEqualsTheCode)
{
    std::map<std::string, std::string> page;
    for (const auto& cells : document().tables.at("5"))
        if (cells.size() == 3)
            page[cells[0]] = cells[1];
    EXPECT_EQ(page["`still`"], std::to_string(frame_flags::kStill));
    EXPECT_EQ(page["`lossless`"], std::to_string(frame_flags::kLossless));
    EXPECT_EQ(page["`history_reset`"], std::to_string(frame_flags::kHistoryReset));
    EXPECT_EQ(page["`converged`"], std::to_string(frame_flags::kConverged));
}

}  // namespace
}  // namespace farlight
