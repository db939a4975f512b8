// farlight bench --turns KEY=A,B: what a setting costs.
#pragma once

#include "client/cli/target.h"

namespace farlight::client {

/// Draws with both values in turns and prints times a pass and their ratio; exit status.
/// `turns`: "KEY=A,B". Throws std::invalid_argument for another form.
int bench_setting(const TargetOptions& target, const std::string& turns, int frames, bool json);

}  // namespace farlight::client
