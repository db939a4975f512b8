// See the header.
#include "lab/evaluate.h"

#include "lab/compute.h"
#include "server/gl/buffer.h"
#include "server/gl/program.h"

#include <bit>
#include <cmath>

namespace farlight::lab {

std::vector<glm::vec4> evaluate(const Expression& expression, std::span<const glm::uvec4> rows)
{
    add_shader_file("lab/expression",
        "#version 450\n" + expression.head + R"(
layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform usamplerBuffer rows;
void main()
{
    const uint row = gl_GlobalInvocationID.x;
    if (row >= uint(results.length()))
        return;
    const uvec4 x_bits = texelFetch(rows, int(row));
    const vec4 x = uintBitsToFloat(x_bits);
    vec4 result = vec4(0.0);
)" + expression.body
            + "\n    results[row] = result;\n}\n");
    const Program program(load_shader_source("lab/expression", expression.defines));
    Buffer buffer("rows", std::as_bytes(rows));
    return run_compute(program, {{"rows", buffer.texture(GL_RGBA32UI)}}, rows.size(), rows.size());
}

std::vector<glm::vec4> evaluate(const Expression& expression, std::span<const glm::vec4> rows)
{
    std::vector<glm::uvec4> bits;
    for (const glm::vec4& row : rows)
        bits.push_back(std::bit_cast<glm::uvec4>(row));
    return evaluate(expression, bits);
}

double ulps_between(float a, double b)
{
    const auto nearest = static_cast<float>(b);
    const double ulp = static_cast<double>(
        std::nextafter(std::abs(nearest), std::numeric_limits<float>::infinity())
        - std::abs(nearest));
    const double off = std::abs(static_cast<double>(a) - b) / ulp;
    return std::isnan(off) ? 1e9 : off;
}

}  // namespace farlight::lab
