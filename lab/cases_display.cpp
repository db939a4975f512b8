// Display: what reaches the eye is in [0, 1], whatever came in.
#include "lab/compute.h"
#include "lab/groups.h"

#include "server/gl/program.h"

#include <bit>

namespace farlight::lab {
namespace {

constexpr const char* kTonemapAll = R"(#version 450
#include "lib/display.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= uint(results.length()))
        return;
    // Every half, then the extremes of 32 bits.
    const uint extremes[8] = uint[](0x7f7fffffu, 0xff7fffffu, 0x00000001u, 0x80000001u, 0x7f800000u, 0xff800000u,
        0x7fc00000u, 0xffc00000u);
    const float x = i < 65536u ? unpackHalf2x16(i).x : uintBitsToFloat(extremes[i - 65536u]);
    const vec3 aces = srgb_encode(tone_curve(vec3(x), 0));
    const vec3 linear = srgb_encode(tone_curve(vec3(x), 1));
    results[i] = vec4(x, aces.x, linear.x, 0.0);
}
)";

void tone_curves_are_total(Findings& findings, Length /*length*/)
{
    add_shader_file("lab/tonemap_all", kTonemapAll);
    const Program program(load_shader_source("lab/tonemap_all"));
    const std::vector<glm::vec4> results = run_compute(program, {}, 65536 + 8, 65536 + 8);
    int outside = 0;
    for (const glm::vec4& r : results)
        for (const float shown : {r.y, r.z})
            outside += shown >= 0 && shown <= 1 ? 0 : 1;
    // Positive halves ascend with their bits, up to infinity.
    int falls = 0;
    for (std::size_t i = 1; i <= 0x7c00; ++i)
        falls +=
            (results[i].y >= results[i - 1].y - 1e-6F && results[i].z >= results[i - 1].z - 1e-6F)
            ? 0
            : 1;
    findings.none("display values outside [0, 1], of 131088", outside);
    findings.none("steps down, of 63488", falls);
}

constexpr Case kDisplayCases[] = {
    {"67", "display", "tone curves are total", Layer::kFunction,
        "Every half and every special value is shown as something in [0, 1], and more light never "
        "as less.",
        tone_curves_are_total},
};

constexpr Guard kDisplayGuards[] = {
    {"displayable_nan", "67", "lib/display.glsl",
        "return vec3(x.r > 0.0 ? min(x.r, MOST_DISPLAYABLE) : 0.0,", "return vec3(x.r,"},
};

}  // namespace

Group display_group()
{
    return {kDisplayCases, kDisplayGuards};
}

}  // namespace farlight::lab
