// The scene files that come with Farlight, in the order of their names.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

namespace farlight {

inline std::vector<std::filesystem::path> shipped_scenes()
{
    std::vector<std::filesystem::path> files;
    const auto folder = std::filesystem::path(FARLIGHT_SOURCE_DIR) / "scenes";
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace farlight
