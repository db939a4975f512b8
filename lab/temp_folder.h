// A folder for a test or a case alone, gone when it is.
#pragma once

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace farlight {

class TempFolder {
public:
    TempFolder()
        : path_(std::filesystem::temp_directory_path()
            / ("farlight-" + std::to_string(std::random_device{}())))
    {
        std::filesystem::create_directories(path_);
    }
    ~TempFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::string_view bytes) const
    {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

private:
    std::filesystem::path path_;
};

}  // namespace farlight
