// Reading, appending.
#include "client/accuracy/journal.h"

#include "client/json_input.h"

#include <set>

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

}  // namespace

json named_files(const std::filesystem::path& scene)
{
    std::ifstream stream(scene);
    std::set<std::string> names;
    collect_strings(json::parse(stream, nullptr, /*allow_exceptions=*/false), names);
    json files = json::array();
    for (const std::string& name : names) {
        const std::filesystem::path file = scene.parent_path() / name;
        std::error_code problem;  // most strings name no file
        if (!std::filesystem::is_regular_file(file, problem))
            continue;
        const auto bytes = std::filesystem::file_size(file, problem);
        const auto changed = std::filesystem::last_write_time(file, problem);
        files.push_back({name, bytes, changed.time_since_epoch().count()});
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
