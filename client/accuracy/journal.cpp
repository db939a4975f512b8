// Reading, appending.
#include "client/accuracy/journal.h"

#include "client/json_input.h"

#include <cctype>
#include <cstring>
#include <set>
#include <string_view>

namespace farlight::client {

using nlohmann::json;

namespace {

void collect_strings(const json& value, std::set<std::string>& strings)
{
    if (value.is_string())
        strings.insert(value.get<std::string>());
    else if (value.is_structured())
        for (const json& part : value)
            collect_strings(part, strings);
}

/// The document of a .json or .gltf file, or of the first chunk of a .glb (glTF 2.0, section 4.4);
/// what is none is discarded.
json document_in(const std::filesystem::path& file)
{
    constexpr std::size_t kChunkData = 20;  // after a header of 12 bytes, length and type
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (text.starts_with("glTF") && text.size() >= kChunkData) {
        std::uint32_t bytes = 0;
        std::memcpy(&bytes, text.data() + 12, sizeof bytes);  // little-endian, as all our machines
        text = text.substr(kChunkData, bytes);
    }
    return json::parse(text, nullptr, /*allow_exceptions=*/false);
}

int hex_digit(char digit)
{
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto at =
        kDigits.find(static_cast<char>(std::tolower(static_cast<unsigned char>(digit))));
    return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

/// "%20" is a blank (RFC 3986, section 2.1).
std::string without_escapes(const std::string& uri)
{
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escaped = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0
            && hex_digit(uri[i + 2]) >= 0;
        name += escaped ? static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2]))
                        : uri[i];
        i += escaped ? 2 : 0;
    }
    return name;
}

/// Adds the files that `file` names and that are there, and those that these name.
void collect_files(const std::filesystem::path& file, std::set<std::filesystem::path>& files)
{
    constexpr std::size_t kLongestName = 4096;  // what is longer holds its data itself
    std::set<std::string> names;
    collect_strings(document_in(file), names);
    for (const std::string& name : names) {
        if (name.size() > kLongestName)
            continue;
        for (const std::string& plain : {name, without_escapes(name)}) {
            const std::filesystem::path named = file.parent_path() / plain;
            std::error_code problem;  // most strings name no file
            if (!std::filesystem::is_regular_file(named, problem) || !files.insert(named).second)
                continue;
            const std::string kind = named.extension();
            if (kind == ".json" || kind == ".gltf" || kind == ".glb")
                collect_files(named, files);
        }
    }
}

}  // namespace

json named_files(const std::filesystem::path& scene)
{
    std::set<std::filesystem::path> named;
    collect_files(scene, named);
    json files = json::array();
    for (const std::filesystem::path& file : named) {
        std::error_code problem;  // one that has gone since has no size
        const auto bytes = std::filesystem::file_size(file, problem);
        const auto changed = std::filesystem::last_write_time(file, problem);
        files.push_back({file.string(), bytes, changed.time_since_epoch().count()});
    }
    return files;
}

Journal::Journal(const std::filesystem::path& file, const json& key)
{
    if (std::filesystem::exists(file))
        load(file, key);
    stream_.open(file, fresh_ ? std::ios::trunc : std::ios::app);
    if (fresh_)
        stream_ << json{{"key", key}}.dump() << std::endl;
    else if (ends_broken_)
        stream_ << std::endl;
    if (!stream_)
        throw InputError(file.string() + ": cannot be written");
}

void Journal::load(const std::filesystem::path& file, const json& key)
{
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    const json first = json::parse(line, nullptr, false);
    if (!first.is_object() || !first.contains("key")) {
        finding_ = file.string() + " is no journal of a sweep: everything is measured anew";
        return;
    }
    if (first["key"] != key) {
        std::string changed;
        for (const auto& [name, value] : key.items())
            if (first["key"].value(name, json()) != value)
                changed += (changed.empty() ? "" : ", ") + name;
        finding_ = "measured before with another " + changed + ": everything is measured anew";
        return;
    }
    while (std::getline(stream, line)) {
        const json entry = json::parse(line, nullptr, false);
        if (entry.is_object() && entry.contains("name") && entry.contains("value"))
            entries_[entry["name"].get<std::string>()] = entry["value"];
        ends_broken_ = stream.eof();  // the line has no end
    }
    fresh_ = false;
    finding_ = "going on: " + std::to_string(entries_.size()) + " measurements are done";
}

const json* Journal::find(const std::string& name) const
{
    const auto found = entries_.find(name);
    return found == entries_.end() ? nullptr : &found->second;
}

void Journal::add(const std::string& name, json value)
{
    stream_ << json{{"name", name}, {"value", value}}.dump() << std::endl;
    if (!stream_)
        throw std::runtime_error("the journal cannot be written: is the disk full?");
    entries_[name] = std::move(value);
}

}  // namespace farlight::client
