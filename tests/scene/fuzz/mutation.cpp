// The values that take the place of others are those that loaders trip over.
#include "tests/scene/fuzz/mutation.h"

#include "tests/scene/gltf_builder.h"

#include <nlohmann/json.hpp>

namespace farlight {

namespace {

using Json = nlohmann::json;

std::size_t below(std::size_t count, std::mt19937& random)
{
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

std::uint32_t word_at(std::string_view bytes, std::size_t offset)
{
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i])) << 8 * i;
    return word;
}

void change_bytes(std::string& bytes, std::mt19937& random)
{
    if (bytes.empty())
        return;
    for (std::size_t n = 1 + below(8, random); n > 0; --n) {
        char& byte = bytes[below(bytes.size(), random)];
        switch (below(3, random)) {
        case 0: byte = static_cast<char>(byte ^ (1 << below(8, random))); break;
        case 1: byte = static_cast<char>(below(256, random)); break;
        default: byte = below(2, random) == 0 ? '\0' : '\xff'; break;
        }
    }
}

/// A value somewhere in the document, nearer to the leaves than to the root.
Json& some_value(Json& root, std::mt19937& random)
{
    Json* value = &root;
    while (value->is_structured() && !value->empty() && below(12, random) != 0)
        value =
            &*std::next(value->begin(), static_cast<std::ptrdiff_t>(below(value->size(), random)));
    return *value;
}

Json odd_value(std::mt19937& random)
{
    static const Json values = Json::parse(R"([0, 1, -1, 2, 3, 5, 7, 255, 256, 65535, 65536,
        4294967295, 4294967296, 1e-300, 1e300, -1e300, 1e38, 1e11, -0.5, 0.5, 0.001, 1.5, "",
        "text", "data:;base64,AAAA", "../x", "SCALAR", "VEC2", "VEC3", "VEC4", "MAT4", [], {},
        null, true, false, [0], [0, 0, 0], [1e30, 0, -1], [0, 0, 0, 0], 5120, 5121, 5122, 5123,
        5125, 5126])");
    return values[below(values.size(), random)];
}

void change_value(Json& root, std::mt19937& random)
{
    Json& value = some_value(root, random);
    switch (below(6, random)) {
    case 0: {
        const Json other = some_value(root, random);
        value = other;
        break;
    }
    case 1:
        if (value.is_array() && !value.empty())
            value.push_back(value[below(value.size(), random)]);
        else
            value = odd_value(random);
        break;
    case 2:
        if (value.is_structured() && !value.empty())
            value.erase(
                std::next(value.begin(), static_cast<std::ptrdiff_t>(below(value.size(), random))));
        else
            value = odd_value(random);
        break;
    case 3:
        if (value.is_number_integer()) {
            value = value.get<std::int64_t>() + (below(2, random) == 0 ? 1 : -1);
            break;
        }
        [[fallthrough]];
    default: value = odd_value(random);
    }
}

}  // namespace

SceneParts split_scene(SceneFormat format, std::string_view bytes)
{
    constexpr std::size_t kHeaders = 20;
    if (format != SceneFormat::kGlb || bytes.size() < kHeaders)
        return {std::string(bytes), {}};
    const std::size_t json = std::min<std::size_t>(word_at(bytes, 12), bytes.size() - kHeaders);
    SceneParts parts{std::string(bytes.substr(kHeaders, json)), {}};
    const std::size_t binary = kHeaders + json + 8;
    if (binary < bytes.size())
        parts.binary = bytes.substr(binary);
    return parts;
}

std::string join_scene(SceneFormat format, const SceneParts& parts)
{
    if (format != SceneFormat::kGlb)
        return parts.json;
    return glb_container(parts.json, parts.binary);
}

void mutate_scene(SceneParts& parts, std::mt19937& random)
{
    if (below(4, random) == 0)
        change_bytes(parts.binary, random);
    Json document = Json::parse(parts.json, nullptr, false);
    if (document.is_discarded() || below(16, random) == 0)
        return change_bytes(parts.json, random);
    for (std::size_t n = 1 + below(4, random); n > 0; --n)
        change_value(document, random);
    parts.json = document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace farlight
