// Journal: what a sweep has measured so far, one JSON line each in a file, so that one that was
// interrupted goes on where it stopped.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace farlight::client {

/// Of each file that a scene (.json, .gltf, .glb) names and that is there, and of those that such a
/// file names in turn: path, bytes and time of its last change, for the journal's key.
nlohmann::json named_files(const std::filesystem::path& scene);

class Journal {
public:
    /// `key` is all that the measurements depend on. A file with another key, or none, is begun
    /// anew; a line that is broken (the last one, of a run that was killed) is left out.
    Journal(const std::filesystem::path& file, const nlohmann::json& key);

    /// "" after a fresh start of an empty folder; else what was found: how much is taken over, or
    /// why nothing is.
    const std::string& finding() const { return finding_; }
    /// Nothing of an earlier run holds.
    bool fresh() const { return fresh_; }

    const nlohmann::json* find(const std::string& name) const;
    /// Written at once. A later entry of the same name replaces an earlier one.
    void add(const std::string& name, nlohmann::json value);

private:
    void load(const std::filesystem::path& file, const nlohmann::json& key);

    std::map<std::string, nlohmann::json> entries_;
    std::string finding_;
    bool fresh_ = true;
    bool ends_broken_ = false;  ///< The file's last line was cut off.
    std::ofstream stream_;
};

}  // namespace farlight::client
