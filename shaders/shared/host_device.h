// Lets one header be read by the C++ and the GLSL compiler: wrap its content in SHARED_BEGIN and SHARED_END.
// Rules: only 32-bit members, every 16-byte row filled, so that std140, std430 and C++ lay it out alike
// (held by tests/render/shared_layout_test.cpp).
#pragma once

#ifdef __cplusplus
#include <glm/glm.hpp>
#define SHARED_BEGIN namespace farlight::shared { using namespace glm; using uint = glm::uint;
#define SHARED_END }
#else
#define SHARED_BEGIN
#define SHARED_END
#endif
