// GLSL evaluated over rows of numbers: how a shader's function meets its oracle.
#pragma once

#include "server/gl/shader_source.h"

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace farlight::lab {

/// What is evaluated: `head` is global (includes, functions), `body` sees `vec4 x`, `uvec4 x_bits`
/// (the same bits) and `uint row`, and assigns `vec4 result`.
struct Expression {
    std::string head;
    std::string body;
    Defines defines;
};

/// result of each row. Throws ShaderError.
std::vector<glm::vec4> evaluate(const Expression& expression, std::span<const glm::uvec4> rows);
std::vector<glm::vec4> evaluate(const Expression& expression, std::span<const glm::vec4> rows);

/// [ulp] between two floats of any sign; NaN to anything: a large number.
double ulps_between(float a, double b);

}  // namespace farlight::lab
