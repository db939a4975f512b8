// See the header.
#include "lab/injections.h"

#include <stdexcept>

namespace farlight::lab {
namespace {

constexpr std::string_view kAll = "nan infinite negative";
constexpr std::string_view kNoNumber = "nan infinite";
constexpr std::string_view kCut = "clamped";

constexpr const char* kGbuffer = "gbuffer/gbuffer.comp";
constexpr const char* kPathTrace = "path_trace/path_trace.comp";
constexpr const char* kTemporal = "svgf/temporal.comp";
constexpr const char* kVariance = "svgf/variance.comp";
constexpr const char* kAtrous = "svgf/atrous.comp";
constexpr const char* kAccumulate = "accumulate/accumulate.comp";

constexpr Injection kInjections[] = {
    {STAGE_PRIMARY_RAY, kNoNumber, kGbuffer, "const Ray ray = ray_of(primary);",
        "const Ray ray = Ray(primary.origin, injected(ray_of(primary).direction));"},
    {STAGE_GBUFFER, kAll, kGbuffer, "m.emission : environment_radiance(ray.direction));",
        "injected(m.emission) : environment_radiance(ray.direction));"},
    {STAGE_GBUFFER, kAll, kGbuffer, "met ? diffuse_albedo(m, s, ray) : vec3(0.0));",
        "met ? injected(diffuse_albedo(m, s, ray)) : vec3(0.0));"},
    {STAGE_GBUFFER, kNoNumber, kGbuffer,
        "met ? motion_of(s.position, s.prev_position) : vec4(0.0);",
        "met ? injected(motion_of(s.position, s.prev_position)) : vec4(0.0);"},
    {STAGE_GBUFFER, kNoNumber, kGbuffer,
        "depth_and_gradient(primary.direction, s.position, s.geometric_normal);",
        "injected(depth_and_gradient(primary.direction, s.position, s.geometric_normal));"},
    {STAGE_HIT, kNoNumber, kPathTrace,
        "        const float way = length(s.position - ray.origin);\n        note_cause",
        "        const float way = injected(length(s.position - ray.origin));\n        note_cause"},
    {STAGE_LIGHT, kAll, "path_trace/direct.glsl",
        "    const Scattered value = scatter(v, light.wi);",
        "    Scattered value = scatter(v, light.wi);\n    value.diffuse = "
        "injected(value.diffuse);"},
    {STAGE_LIGHT, kAll, "path_trace/direct.glsl", "kinds_in(vec3(light.pdf, value.pdf, 0.0))",
        "kinds_in(vec3(light.pdf, injected(value.pdf), 0.0))"},
    {STAGE_THROUGHPUT, kAll, kPathTrace, "next = throughput * weight;",
        "next = injected(throughput * weight);"},
    {STAGE_THROUGHPUT, kAll, kPathTrace, "    const vec3 weight = bounce.weight.diffuse",
        "    const vec3 weight = injected(bounce.weight.diffuse)"},
    {STAGE_FOG, kAll, kPathTrace, "note_cause(STAGE_FOG, alive ? kinds_in(event.weight) : 0u);",
        "note_cause(STAGE_FOG, alive ? kinds_in(injected(event.weight)) : 0u);"},
    {STAGE_FOG, kAll, kPathTrace, "    scattered *= weight;",
        "    scattered = injected(scattered);"},
    {STAGE_RADIANCE, kAll, kPathTrace, "const vec3 direct = sum.direct * weight;",
        "const vec3 direct = injected(sum.direct * weight);"},
    {STAGE_RADIANCE, kAll, kPathTrace, "const vec3 indirect = sum.indirect * weight;",
        "const vec3 indirect = injected(sum.indirect * weight);"},
    {STAGE_HISTORY, kAll, kTemporal, "old.first /= weight;", "old.first = injected(old.first);"},
    {STAGE_HISTORY, kAll, kTemporal, "old.moments /= weight;",
        "old.moments = injected(old.moments);"},
    {STAGE_HISTORY, kNoNumber, kTemporal, "old.half_difference /= weight;",
        "old.half_difference = vec2(injected(old.half_difference.x));"},
    {STAGE_TEMPORAL, kAll, kTemporal, "first = blend_light(old.first, first, alpha);",
        "first = injected(blend_light(old.first, first, alpha));"},
    {STAGE_TEMPORAL, kAll, kTemporal, "second = blend_light(old.second, second, alpha);",
        "second = injected(blend_light(old.second, second, alpha));"},
    {STAGE_MOMENTS, kAll, kTemporal, "blend_moments(old.moments.zw, moments.z, alpha_moments));",
        "blend_moments(old.moments.zw, moments.z, alpha_moments));\n"
        "            moments.y = injected(moments.y);"},
    {STAGE_MOMENTS, kCut, kTemporal, "const float delta = value - old.x;",
        "const float delta = min(injected(value - old.x), 2e18);"},
    {STAGE_VARIANCE, kAll, kVariance, "const vec2 spread = m.yw - m.xz * m.xz;",
        "const vec2 spread = vec2(injected((m.yw - m.xz * m.xz).x));"},
    {STAGE_VARIANCE, kCut, kVariance, "const vec2 off = moments.xz - center.xz;",
        "const vec2 off = vec2(injected((moments.xz - center.xz).x));"},
    {STAGE_COMPOSITE, kAll, "composite/composite.comp", "compose(px, emission, light));",
        "injected(compose(px, emission, light)));"},
    {STAGE_ACCUMULATE, kAll, kAccumulate, "    const uint kinds = kinds_in(mean, variance);",
        "    mean = injected(mean);\n    const uint kinds = kinds_in(mean, variance);", 1, true},
    {STAGE_ACCUMULATE, kCut, kAccumulate, "(radiance - old) * (radiance - mean);",
        "injected((radiance - old) * (radiance - mean));", 2, true},
    {STAGE_ACCUMULATE, kAll, "accumulate/refine.comp", "mix_of_both : known;",
        "injected(mix_of_both) : known;", 1, true},
    {STAGE_ERROR_ESTIMATE, kNoNumber, "error_estimate/tiles.glsl",
        "const vec4 one = sums_at(first + ivec2(x, y));",
        "const vec4 one = injected_at(first + ivec2(x, y), sums_at(first + ivec2(x, y)));", 2},
    {STAGE_TONEMAP, "nan infinite negative clamped", "tonemap/tonemap.comp",
        "const vec3 radiance = texelFetch(in_radiance, px, 0).rgb;",
        "const vec3 radiance = injected(texelFetch(in_radiance, px, 0).rgb);", 1, false, true},
    // Of the wavelet filter's passes, which share a shader: below, by step.
    {STAGE_ATROUS_1, kAll, kAtrous, "", ""},
    {STAGE_ATROUS_1 + 1, kAll, kAtrous, "", ""},
    {STAGE_ATROUS_1 + 2, kAll, kAtrous, "", ""},
    {STAGE_ATROUS_1 + 3, kAll, kAtrous, "", ""},
    {STAGE_ATROUS_1 + 4, kAll, kAtrous, "", ""},
    {STAGE_ATROUS_1 + 5, kCut, kAtrous, "", ""},
    {STAGE_ATROUS_1 + 6, kAll, kAtrous, "", ""},
    {STAGE_ATROUS_1 + 7, kCut, kAtrous, "", ""},
};

constexpr std::string_view kAtrousMean = "const Light mean = Light(sum *";

/// What every shader that counts can call; ROW is replaced by what stands there.
constexpr const char* kFunctions = R"(
bool injects(uint row, ivec2 px)
{
#ifdef SIGNAL_SCATTERED
    return false;  // of the filter's kinds of signals one is enough
#else
    return px == ivec2(9, 6) && frame.seed / KIND_COUNT == row;
#endif
}
float bad_value()
{
    const uint bits[4] = uint[](0x7fc00000u, 0x7f800000u, 0xbf800000u, 0x7f61b1e6u);
    return uintBitsToFloat(bits[frame.seed % KIND_COUNT]);
}
float injected(uint row, float x) { return injects(row, ivec2(gl_GlobalInvocationID.xy)) ? bad_value() : x; }
vec3 injected(uint row, vec3 x) { return injects(row, ivec2(gl_GlobalInvocationID.xy)) ? vec3(bad_value(), x.yz) : x; }
vec4 injected(uint row, vec4 x) { return injects(row, ivec2(gl_GlobalInvocationID.xy)) ? vec4(x.x, bad_value(), x.zw) : x; }
vec4 injected_at(uint row, ivec2 px, vec4 x) { return injects(row, px) ? vec4(bad_value(), x.yzw) : x; }
)";

void replace_once(std::string& text, std::string_view what, const std::string& with)
{
    const std::size_t at = text.find(what);
    if (at == std::string::npos || text.find(what, at + 1) != std::string::npos)
        throw std::logic_error("not there once: " + std::string(what));
    text.replace(at, what.size(), with);
}

/// Each call told which row it is.
std::string calls_of_row(std::string_view instead, std::size_t row)
{
    std::string text(instead);
    for (const std::string_view call : {"injected(", "injected_at("})
        for (std::size_t at = 0; (at = text.find(call, at)) != std::string::npos;) {
            at += call.size();
            text.insert(at, std::to_string(row) + "u, ");
        }
    return text;
}

/// The row of the first pass of the wavelet filter, counted from 1; the others follow it.
std::size_t first_atrous_row()
{
    std::size_t row = 1;
    while (kInjections[row - 1].stage != STAGE_ATROUS_1)
        ++row;
    return row;
}

}  // namespace

std::span<const Injection> InjectingShaders::all()
{
    return kInjections;
}

InjectingShaders::InjectingShaders() : clean_(shader_files())
{
    auto& files = shader_files();
    files.at("lib/counters.glsl") += kFunctions;
    for (std::size_t i = 0; i < std::size(kInjections); ++i) {
        const Injection& row = kInjections[i];
        if (!row.text.empty())
            replace_once(
                files.at(std::string(row.file)), row.text, calls_of_row(row.instead, i + 1));
    }
    const std::string row_of_step =
        std::to_string(first_atrous_row()) + "u + uint(findMSB(step_size))";
    replace_once(files.at(kAtrous), kAtrousMean, "Light mean = Light(sum *");
    replace_once(files.at(kAtrous), "    store_light(stage,",
        "    if (frame.seed % KIND_COUNT == KIND_CLAMPED)\n"
        "        mean.first.a = injected("
            + row_of_step
            + ", mean.first.a);\n"
              "    else\n"
              "        mean.first = injected("
            + row_of_step + ", mean.first);\n    store_light(stage,");
}

InjectingShaders::~InjectingShaders()
{
    shader_files() = clean_;
}

}  // namespace farlight::lab
