// The command line of farlight-server.
#pragma once

#include "server/render/renderer.h"
#include "server/stream/hub.h"

#include <filesystem>
#include <optional>
#include <spdlog/common.h>

namespace farlight {

/// Exit status.
constexpr int kWrongUsage = 2;

struct Flags {
    std::filesystem::path scene;
    std::filesystem::path frontier;  ///< A report; empty: none.
    RendererOptions renderer;
    StreamOptions stream;
    spdlog::level::level_enum log_level = spdlog::level::info;
    bool list_devices = false;
};

/// "640x360". Nothing if `text` is anything else or a side is 0.
std::optional<Extent> parse_extent(std::string_view text);

/// Reads the command line. Where there is nothing more to do (--help, --version, wrong usage) says
/// so on stdout or stderr and returns the exit status instead: 0 or kWrongUsage.
std::variant<Flags, int> parse_flags(int argc, const char* const* argv);

}  // namespace farlight
