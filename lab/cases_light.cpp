// Light that changes or is rarely found: what the filter makes of it over time.
#include "lab/groups.h"
#include "lab/whole_filter.h"

#include <cmath>
#include <random>

namespace farlight::lab {
namespace {

Texels even_light(float value)
{
    return Texels(place_of(0, kFiltered.height), glm::vec4(glm::vec3(value), 0));
}

glm::uvec4 wall_all_over(int /*x*/, int /*y*/)
{
    return wall_at(kWallDepth);
}

double brightest(const Texels& picture)
{
    double most = 0;
    for (const glm::vec4& texel : picture)
        most = texel.x <= most ? most : static_cast<double>(texel.x);
    return most;
}

/// An exponential average never gets to zero by itself: below the least normal number a fifth of it
/// rounds to nothing, and it stays.
void light_goes_out(Findings& findings, Length /*length*/)
{
    const std::unique_ptr<PassBench> bench = filter_bench("temporal", kFiltered);
    double left = 0;
    for (int frame = 0; frame < 520; ++frame) {
        bench->fill("in_light", GL_RGBA32F, glm::vec4(frame < 10 ? 1.0F : 0.0F));
        bench->constant("history_valid", frame > 0 ? 1 : 0);
        bench->run();
        bench->swap("prev_light", "out_light");
        bench->swap("prev_light_2", "out_light_2");
        bench->swap("prev_moments", "out_moments");
        bench->swap("prev_length", "out_length");
    }
    for (const glm::vec4& texel : bench->read("prev_light"))
        left += texel.x == 0 ? 0 : 1;
    findings.none("pixels that still shine 510 frames after", left);
}

void light_goes_out_soon(Findings& findings, Length /*length*/)
{
    WholeFilter filter(wall_all_over);
    for (int frame = 0; frame < 10; ++frame)
        filter.frame(even_light(1));
    double left = 0;
    for (int frame = 0; frame < 8; ++frame)
        left = brightest(filter.frame(even_light(0)));
    findings.known_to_fail("light left eight frames after it went out", left, 0.05, 0.17,
        "in Schied et al. 2017 a new frame weighs a fifth, whatever it shows: no weight adapts to "
        "change");
}

/// Of light that one sample in a hundred finds.
void rare_light_keeps_its_mean(Findings& findings, Length /*length*/)
{
    WholeFilter filter(wall_all_over);
    std::mt19937 random(3);
    std::bernoulli_distribution lucky(0.01);
    double in = 0;
    double out = 0;
    for (int frame = 0; frame < 64; ++frame) {
        Texels light = even_light(0);
        for (glm::vec4& texel : light)
            texel = glm::vec4(glm::vec3(lucky(random) ? 100.0F : 0.0F), 0);
        const Texels& picture = filter.frame(light);
        for (std::size_t i = 0; i < light.size(); ++i) {
            in += light[i].x;
            out += picture[i].x;
        }
    }
    const double lost = std::abs(out / in - 1);
    findings.known_to_fail("energy lost in 64 frames, of it", lost, 0.01, 0.45,
        "the luminance edge stop of Schied et al. 2017 looks at the variance of one side only: "
        "dark pixels refuse what bright ones give away; with both sides' the pictures' "
        "relMSE is a quarter larger");
}

constexpr Case kLightCases[] = {
    {"65", "light", "light goes out", Layer::kFunction,
        "After light went out nothing is left of it, exactly.", light_goes_out},
    {"65b", "light", "light goes out soon", Layer::kFunction,
        "A twentieth of the light is left eight frames after it went out.", light_goes_out_soon},
    {"66", "light", "rare light", Layer::kFunction,
        "The filter loses no light of which one sample in a hundred knows.",
        rare_light_keeps_its_mean},
};

constexpr Guard kLightGuards[] = {
    {"least_light", "65", "svgf/temporal.comp",
        "return mix(light, vec3(0.0), lessThan(light, vec3(LEAST_LIGHT)));", "return light;"},
};

}  // namespace

Group light_group()
{
    return {kLightCases, kLightGuards};
}

}  // namespace farlight::lab
