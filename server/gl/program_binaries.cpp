// A file an entry: a fixed header that says what it is the binary of, and its hash; then the bytes.
#include "server/gl/program_binaries.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <xxhash.h>

namespace farlight {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic{'F', 'A', 'R', 'L', 'P', 'R', 'G', '1'};

/// Little-endian as all machines we build for.
struct EntryHeader {
    std::array<char, 8> magic;
    XXH128_hash_t key;  ///< Of sources, defines and driver.
    std::uint64_t size;  ///< [bytes] of the binary.
    std::uint64_t hash;  ///< Of the binary.
    std::uint64_t format;
};

XXH128_hash_t key_of(const ShaderSource& source, const std::string& driver)
{
    // The text has its defines in it. Lengths keep parts from running into each other.
    const std::string all = std::to_string(driver.size()) + "\n" + driver + source.text;
    return XXH3_128bits(all.data(), all.size());
}

std::string hex(XXH128_hash_t key)
{
    char text[33];
    std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(key.high64),
        static_cast<unsigned long long>(key.low64));
    return text;
}

bool is_of(const EntryHeader& header, XXH128_hash_t key)
{
    return header.magic == kMagic && XXH128_isEqual(header.key, key) != 0;
}

}  // namespace

ProgramBinaries::ProgramBinaries(fs::path folder, std::string driver, std::uintmax_t most_bytes)
    : folder_(std::move(folder))
    , driver_(std::move(driver))
    , most_bytes_(most_bytes)
{
}

fs::path ProgramBinaries::file_of(const ShaderSource& source) const
{
    return folder_ / (hex(key_of(source, driver_)) + ".bin");
}

std::optional<ProgramBinary> ProgramBinaries::load(const ShaderSource& source) const
{
    const fs::path path = file_of(source);
    std::error_code ignored;
    const std::uintmax_t file_bytes = fs::file_size(path, ignored);
    std::ifstream file(path, std::ios::binary);
    EntryHeader header{};
    if (!file.read(reinterpret_cast<char*>(&header), sizeof header)
        || !is_of(header, key_of(source, driver_)) || file_bytes != sizeof header + header.size)
        return std::nullopt;
    ProgramBinary binary{static_cast<std::uint32_t>(header.format), {}};
    binary.bytes.resize(header.size);
    file.read(reinterpret_cast<char*>(binary.bytes.data()),
        static_cast<std::streamsize>(binary.bytes.size()));
    if (!file || XXH3_64bits(binary.bytes.data(), binary.bytes.size()) != header.hash)
        return std::nullopt;
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);  // used: not the oldest
    return binary;
}

void ProgramBinaries::store(const ShaderSource& source, const ProgramBinary& binary) const
{
    const fs::path path = file_of(source);
    // Readers see all of an entry or none of it: it appears under its name when it is whole.
    const fs::path unfinished = path.string() + "." + std::to_string(getpid()) + "-"
        + std::to_string(reinterpret_cast<std::uintptr_t>(&binary)) + ".tmp";
    std::error_code problem;
    fs::create_directories(folder_, problem);
    EntryHeader header{};
    header.magic = kMagic;
    header.key = key_of(source, driver_);
    header.size = binary.bytes.size();
    header.hash = XXH3_64bits(binary.bytes.data(), binary.bytes.size());
    header.format = binary.format;
    {
        std::ofstream file(unfinished, std::ios::binary);
        file.write(reinterpret_cast<const char*>(&header), sizeof header);
        file.write(reinterpret_cast<const char*>(binary.bytes.data()),
            static_cast<std::streamsize>(binary.bytes.size()));
        file.close();
        if (!file)
            problem = std::make_error_code(std::errc::io_error);
    }
    if (!problem)
        fs::rename(unfinished, path, problem);
    if (problem) {
        spdlog::debug("program cache: {} cannot be written", path.string());
        fs::remove(unfinished, problem);
        return;
    }
    make_room();
}

void ProgramBinaries::make_room() const
{
    struct Entry {
        fs::file_time_type used;
        std::uintmax_t bytes;
        fs::path path;
    };
    std::vector<Entry> entries;
    std::uintmax_t total = 0;
    std::error_code problem;
    for (const auto& file : fs::directory_iterator(folder_, problem)) {
        std::error_code gone;  // another process may tidy up too
        Entry entry{file.last_write_time(gone), file.file_size(gone), file.path()};
        if (gone || !file.is_regular_file(gone))
            continue;
        total += entry.bytes;
        entries.push_back(std::move(entry));
    }
    std::sort(entries.begin(), entries.end(),
        [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (const Entry& entry : entries) {
        if (total <= most_bytes_)
            return;
        fs::remove(entry.path, problem);
        total -= entry.bytes;
    }
}

}  // namespace farlight
