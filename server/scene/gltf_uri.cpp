// URIs: glTF 2.0 specification, section 2.8.
#include "server/scene/gltf_uri.h"

#include "server/scene/json_text.h"

#include <tiny_gltf.h>

namespace farlight {

namespace {

/// "a%20b" -> "a b".
std::string percent_decoded(std::string_view uri)
{
    const auto digit = [](char c) {
        const std::string_view digits = "0123456789abcdef";
        return digits.find(static_cast<char>(c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c));
    };
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool coded = uri[i] == '%' && i + 2 < uri.size()
            && digit(uri[i + 1]) != std::string_view::npos
            && digit(uri[i + 2]) != std::string_view::npos;
        if (!coded) {
            path += uri[i];
            continue;
        }
        path += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
        i += 2;
    }
    return path;
}

/// The media type is not looked at: files say many things.
std::string read_data_uri(const std::string& uri, const ScenePlace& place)
{
    constexpr std::string_view kMarker = ";base64,";
    const std::size_t marker = uri.find(kMarker);
    if (marker == std::string::npos)
        refuse(place, in_quotes(uri), "a data URI with ;base64,");
    const std::size_t start = marker + kMarker.size();
    const std::size_t digits = uri.find_last_not_of('=') + 1 - start;
    std::vector<unsigned char> bytes;
    std::string type;
    tinygltf::DecodeDataURI(
        &bytes, type, "data:application/octet-stream;base64," + uri.substr(start), 0, false);
    if (bytes.size() != digits * 3 / 4)  // it stops at what is not base64
        refuse(place, in_quotes(uri), "base64 after the comma");
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string read_gltf_uri(
    const std::string& uri, const std::filesystem::path& folder, const ScenePlace& place)
{
    if (uri.starts_with("data:"))
        return read_data_uri(uri, place);
    const std::filesystem::path path = percent_decoded(uri);
    if (uri.empty() || uri.find("://") != std::string::npos || path.is_absolute())
        refuse(place, in_quotes(uri), "a data URI or a path relative to the file");
    const std::filesystem::path file = folder / path;
    std::error_code error;  // a name may be too long to ask for
    if (!std::filesystem::is_regular_file(file, error))
        refuse(place, in_quotes(uri) + ", and no such file", "a file of bytes");
    return read_file(file);
}

}  // namespace farlight
