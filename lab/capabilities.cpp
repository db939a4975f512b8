// See the header.
#include "lab/capabilities.h"

#include "lab/compute.h"
#include "lab/pass_bench.h"
#include "server/gl/buffer.h"

#include <bit>
#include <cmath>
#include <cstdio>

namespace farlight::lab {
namespace {

/// Operands come from a buffer, so that no compiler knows them.
constexpr const char* kHead = R"(#version 450
layout(local_size_x = 1) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform samplerBuffer operands;
float at(int i) { return texelFetch(operands, i).x; }
void main()
{
    const float zero = at(0), one = at(1), nan = at(2), inf = at(3), tiny = at(4), denormal = at(5), large = at(6);
    precise float uncontracted = (one + 0.000244140625) * (one + 0.000244140625);
    uncontracted = uncontracted - (one + 0.00048828125);
)";

struct Probe {
    const char* expression;  ///< GLSL, of the operands above.
    const char* left_open;
    bool bits = false;  ///< The result is an unsigned number in a float's bits.
};

constexpr Probe kProbes[] = {
    {"min(nan, one)", "either operand"},
    {"min(one, nan)", "either operand"},
    {"max(nan, one)", "either operand"},
    {"max(one, nan)", "either operand"},
    {"clamp(nan, zero, one)", "anything: NaN may pass"},
    {"mix(inf, one, one)", "NaN by the formula: histories are reset by selecting, never by mixing"},
    {"mix(one, inf, zero)", "NaN by the formula"},
    {"zero * nan", "0 where the compiler drops the product: never a test"},
    {"nan == nan ? one : zero", "may be folded: NaN is told by its bits"},
    {"isnan(nan) ? one : zero", "may be folded"},
    {"fract(-tiny)", "may be 1: an index one past the end"},
    {"pow(zero, zero)", "undefined"},
    {"normalize(vec3(zero)).x", "undefined"},
    {"acos(one + 1e-6)", "undefined"},
    {"atan(zero, zero)", "undefined: straight up in an environment map"},
    {"sqrt(-one)", "undefined"},
    {"inversesqrt(zero)", "undefined"},
    {"uintBitsToFloat(uint(nan))", "undefined: an index out of bounds", true},
    {"unpackHalf2x16(packHalf2x16(vec2(70000.0 * one))).x", "overflow of half: infinity or 65504"},
    {"unpackHalf2x16(packHalf2x16(vec2(1.0 + 0.00073 * one))).x",
        "1.00097656: to nearest, 1: to zero"},
    {"denormal * 2.0 > zero ? one : zero", "0: small numbers are flushed"},
    {"large * large", "infinity"},
    {"(one + 0.000244140625) * (one + 0.000244140625) - (one + 0.00048828125)",
        "not 0: contracted into an fma"},
    {"uncontracted", "the same declared precise: not 0 is an error of the compiler"},
};

/// What a store into a texture of halves makes of a value that lies between two of them.
constexpr const char* kHalfStore = R"(#version 450
layout(local_size_x = 1) in;
uniform float value;
uniform writeonly image2D out_half;
void main() { imageStore(out_half, ivec2(0), vec4(value)); }
)";

float stored_as_half(float value)
{
    add_shader_file("lab/half_store", kHalfStore);
    PassBench bench("lab/half_store", {}, {1, 1});
    bench.fill("out_half", GL_RGBA16F, glm::vec4(0));
    bench.constant("value", value);
    bench.run();
    return bench.read("out_half")[0].x;
}

constexpr float kNan = std::bit_cast<float>(0x7fc00000U);
constexpr float kInfinity = std::bit_cast<float>(0x7f800000U);
constexpr float kOperands[] = {0, 1, kNan, kInfinity, 1e-10F, 1e-40F, 3e38F};

std::string shown(float value, bool bits)
{
    char text[40];
    if (bits)
        std::snprintf(text, sizeof text, "0x%08x", std::bit_cast<unsigned>(value));
    else
        std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
    return text;
}

}  // namespace

std::vector<Capability> capabilities()
{
    std::string shader = kHead;
    for (std::size_t i = 0; i < std::size(kProbes); ++i)
        shader += "    results[" + std::to_string(i) + "] = vec4(" + kProbes[i].expression + ");\n";
    add_shader_file("lab/capabilities", shader + "}\n");
    const Program program(load_shader_source("lab/capabilities"));
    Buffer operands("operands", std::as_bytes(std::span<const float>(kOperands)));
    const std::vector<glm::vec4> results =
        run_compute(program, {{"operands", operands.texture(GL_R32F)}}, std::size(kProbes), 1);
    std::vector<Capability> sheet;
    for (std::size_t i = 0; i < std::size(kProbes); ++i)
        sheet.push_back(
            {kProbes[i].expression, shown(results[i].x, kProbes[i].bits), kProbes[i].left_open});
    for (const float value : {1.00073F, 70000.0F})
        sheet.push_back({"half(" + shown(value, false) + "), stored in a texture",
            shown(stored_as_half(value), false),
            value > 2 ? "overflow: infinity or 65504" : "1.00097656: to nearest, 1: to zero"});
    return sheet;
}

}  // namespace farlight::lab
