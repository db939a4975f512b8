// The whole measurement of a scene: reference, errors, times, responses, pictures; kept as it goes,
// so that one that was interrupted goes on.
#pragma once

#include "client/accuracy/plans.h"
#include "client/accuracy/progress.h"

#include <filesystem>

namespace farlight::client {

struct SweepOptions {
    SweepExtent extent;
    std::filesystem::path out;
    std::filesystem::path scene;  ///< The scene's file; empty: a running server's.
    std::string server;  ///< What tells this server's build from others.
};

/// Measures what the folder does not hold yet. The report as REPORT.md describes it, with its part
/// "gallery". Throws Interrupted; SessionError, ConnectionError, MetricError.
/// `hello` says whatever sessions have in common: size and settings.
nlohmann::json sweep(
    const Url& url, const protocol::Hello& hello, const SweepOptions& options, Progress& progress);

}  // namespace farlight::client
