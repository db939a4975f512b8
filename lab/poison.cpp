// See the header.
#include "lab/poison.h"

#include <stdexcept>

namespace farlight::lab {
namespace {

constexpr PoisonedStage kStages[] = {
    {"path_trace/path_trace.comp", "out_direct", "true", true, true},
    {"path_trace/path_trace.comp", "out_indirect", "true", true, true},
    {"path_trace/path_trace.comp", "out_specular", "true", true, true, false, "FX_SPECULAR_SIGNAL"},
    {"path_trace/path_trace.comp", "out_scattered", "true", true, true, false, "FX_FOG"},
    {"gbuffer/gbuffer.comp", "out_surface", "true", false, true, true},
    {"gbuffer/gbuffer.comp", "out_motion", "true", false, true},
    {"gbuffer/gbuffer.comp", "out_emission", "true", true, false},
    {"gbuffer/gbuffer.comp", "out_albedo", "true", true, false},
    {"svgf/temporal.comp", "out_light", "true", true, true},
    {"svgf/temporal.comp", "out_light_2", "true", true, true, false, "SIGNAL_PAIR"},
    {"svgf/temporal.comp", "out_moments", "true", true, true},
    {"svgf/temporal.comp", "out_length", "true", false, true},
    {"svgf/variance.comp", "out_light", "true", true, true},
    {"svgf/atrous.comp", "out_light", "step_size == 1", true, true},
    {"svgf/atrous.comp", "out_light_2", "step_size == 2", true, true, false, "SIGNAL_PAIR"},
    {"svgf/atrous.comp", "out_light", "step_size == 4", true, true},
    {"svgf/atrous.comp", "out_light", "step_size == 8", true, false},
    {"svgf/atrous.comp", "out_light_2", "step_size == 16", true, false, false, "SIGNAL_PAIR"},
};

/// What comes after the stage's own main(); statements and a brace follow.
constexpr const char* kPoisoningMain = R"(
void main()
{
    clean_main();
    const uint bits[4] = uint[](0x7fc00000u, 0x7f800000u, 0xff800000u, 0xbf800000u);
    const uint poison = bits[frame.seed & 3u];
    const ivec2 poisoned_pixel = ivec2(9, 6);
    if (ivec2(gl_GlobalInvocationID.xy) != poisoned_pixel)
        return;
)";

std::string write_of(const PoisonedStage& stage, std::size_t index)
{
    const std::string kind = std::to_string(index + 1) + "u";
    const std::string value = stage.bits ? "uvec4(poison)" : "vec4(uintBitsToFloat(poison))";
    const std::string statement = "    if (frame.seed / 4u == " + kind + " && " + stage.condition
        + ")\n        imageStore(" + stage.output + ", poisoned_pixel, " + value + ");\n";
    return stage.only_with == nullptr
        ? statement
        : "#ifdef " + std::string(stage.only_with) + "\n" + statement + "#endif\n";
}

}  // namespace

std::span<const PoisonedStage> PoisonedShaders::stages()
{
    return kStages;
}

PoisonedShaders::PoisonedShaders() : clean_(shader_files())
{
    std::map<std::string, std::string> writes;
    for (std::size_t i = 0; i < std::size(kStages); ++i)
        writes[kStages[i].file] += write_of(kStages[i], i);
    const std::string begin = "void main()\n";
    for (const auto& [file, statements] : writes) {
        std::string& text = shader_files().at(file);
        const std::size_t at = text.find(begin);
        if (at == std::string::npos)
            throw std::logic_error(file + " has no main()");
        text.replace(at, begin.size(), "void clean_main()\n");
        text.append(kPoisoningMain).append(statements).append("}\n");
    }
}

PoisonedShaders::~PoisonedShaders()
{
    shader_files() = clean_;
}

}  // namespace farlight::lab
