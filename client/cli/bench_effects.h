// farlight bench --effects: what it saves to compile only what a scene calls for.
#pragma once

#include "client/cli/target.h"

namespace farlight::client {

struct EffectsBenchOptions {
    std::vector<std::string> scenes;  ///< Empty: the target's.
    int frames = 24;  ///< Of each kind of program and scene.
    bool leave_one_in = false;  ///< Also, of the first scene, the cost of each effect it lacks.
    bool json = false;
};

/// Exit status: 1 where a scene's own programs are slower than 1.01 times the general ones for
/// certain.
int bench_effects(const TargetOptions& target, EffectsBenchOptions options);

}  // namespace farlight::client
