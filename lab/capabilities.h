// What the device makes of arithmetic that GLSL leaves open. Our shaders rely on none of it; the
// sheet says what a failing case may have met.
#pragma once

#include <string>
#include <vector>

namespace farlight::lab {

struct Capability {
    std::string expression;
    std::string result;
    std::string left_open;  ///< What the specification allows, or where it bites.
};

/// Asks the current context.
std::vector<Capability> capabilities();

}  // namespace farlight::lab
