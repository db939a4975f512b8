// ProgramBinaries: linked programs kept in a folder from one run to the next.
//
// An entry is only ever a short cut: one that is missing, cut short, damaged, of another program or
// of another driver is a miss, and the program is compiled from its sources.
#pragma once

#include "server/gl/shader_source.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace farlight {

/// What glGetProgramBinary gives.
struct ProgramBinary {
    std::uint32_t format = 0;
    std::vector<std::byte> bytes;
};

/// Thread-safe; several processes may share a folder.
class ProgramBinaries {
public:
    /// `driver` tells one driver's binaries from another's: vendor, renderer, version. The folder
    /// is made when first needed. Oldest entries go when all take more than `most_bytes`.
    ProgramBinaries(
        std::filesystem::path folder, std::string driver, std::uintmax_t most_bytes = 64U << 20U);

    std::optional<ProgramBinary> load(const ShaderSource& source) const;
    /// Where it cannot be written nothing happens but a line in the log.
    void store(const ShaderSource& source, const ProgramBinary& binary) const;

    /// The file that holds, or would hold, the entry of a program.
    std::filesystem::path file_of(const ShaderSource& source) const;

private:
    void make_room() const;

    std::filesystem::path folder_;
    std::string driver_;
    std::uintmax_t most_bytes_;
};

}  // namespace farlight
