// Where fuzzing starts: our scenes, and small glTF files that between them have all that is read.
#pragma once

#include "tests/scene/fuzz/scene_input.h"

#include <ostream>
#include <vector>

namespace farlight {

struct Seed {
    std::string name;
    SceneFormat format;
    std::string bytes;
};

/// For GoogleTest.
inline void PrintTo(const Seed& seed, std::ostream* out)
{
    *out << seed.name;
}

std::vector<Seed> fuzz_seeds();

}  // namespace farlight
