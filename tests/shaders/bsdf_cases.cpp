// Each lobe at all angles, mixtures, and normals that lean.
#include "tests/shaders/bsdf_cases.h"

#include <cmath>
#include <functional>

namespace farlight {
namespace {

Material white(float metallic, float roughness)
{
    return {.name = "", .albedo = glm::vec3(1), .metallic = metallic, .roughness = roughness};
}

Material plastic(float roughness)
{
    Material m = white(0, roughness);
    m.specular = 1;
    return m;
}

Material glass(float roughness, float ior = 1.5F)
{
    Material m = plastic(roughness);
    m.transmission = 1;
    m.ior = ior;
    return m;
}

Material coated(Material m, float roughness)
{
    m.clearcoat = 1;
    m.clearcoat_roughness = roughness;
    return m;
}

/// Every roughness from a mirror to the roughest, from straight on to grazing.
std::vector<BsdfCase> at_all_angles(const char* name,
    const std::function<Material(float)>& material, double tolerance = 1e-3, bool inside = false)
{
    std::vector<BsdfCase> list;
    for (const float roughness : {0.0F, 0.032F, 0.1F, 0.3F, 0.6F, 1.0F})
        for (const double cosine : {1.0, 0.6, 0.1, 0.01}) {
            // Seen at 0.6 degrees a lobe of 0.1 degrees is too thin for the histogram.
            if (roughness == 0.032F && cosine < 0.05)
                continue;
            const std::string at = "R" + std::to_string(std::lround(roughness * 1000)) + "C"
                + std::to_string(std::lround(cosine * 100));
            list.push_back(
                {name + at, material(roughness), cosine, inside, {}, {}, true, tolerance});
        }
    return list;
}

/// Lobes of several kinds at once.
std::vector<BsdfCase> mixtures()
{
    Material half_metal = plastic(0.4F);
    half_metal.metallic = 0.5F;
    Material frosted_paint = glass(0.5F);
    frosted_paint.transmission = 0.4F;
    frosted_paint.metallic = 0.3F;
    Material thin_smooth = glass(0);
    thin_smooth.thin_walled = true;
    Material thin_rough = glass(0.5F);
    thin_rough.thin_walled = true;
    Material tinted = plastic(0.3F);
    tinted.specular_color = {1, 0.5F, 0.1F};
    tinted.specular = 0.7F;
    const Material all = coated(frosted_paint, 0.2F);
    return {{"HalfMetal", half_metal}, {"FrostedPaint", frosted_paint},
        {"FrostedPaintInside", frosted_paint, 0.7, true, {}, {}, true, 2e-3},
        {"ThinSmooth", thin_smooth}, {"ThinRough", thin_rough}, {"Tinted", tinted},
        {"Everything", all, 0.7, false, {}, {}, true, 2e-3},
        {"EverythingGrazing", all, 0.05, false, {}, {}, true, 2e-3},
        {"MirrorUnderCoat", coated(white(1, 0), 0.3F)},
        {"MirrorCoatOverRough", coated(plastic(0.4F), 0)}, {"NoInterface", glass(0.5F, 1)},
        {"AlmostNoInterface", glass(0.5F, 1.003F), 0.7, false, {}, {}, true, 5e-3},
        {"Diamond", glass(0.3F, 2.42F), 0.7, false, {}, {}, true, 2e-3}};
}

/// The shading normal leans away from the geometric one, towards the viewer or away.
std::vector<BsdfCase> leaning()
{
    std::vector<BsdfCase> list;
    for (const double cosine : {0.9, 0.3})
        for (const glm::vec2 tilt : {glm::vec2(0.3F, 0.2F), glm::vec2(-0.25F, 0.1F)}) {
            const std::string at =
                (tilt.x > 0 ? "To" : "Away") + std::to_string(std::lround(cosine * 10));
            const auto add = [&](const char* name, const Material& m) {
                list.push_back({name + at, m, cosine, false, tilt, {}, true, 2e-3});
            };
            add("Lambert", white(0, 1));
            add("Metal", white(1, 0.4F));
            add("Plastic", plastic(0.5F));
            add("Glass", glass(0.4F));
            add("SmoothGlass", glass(0));
            add("Coated", coated(plastic(0.5F), 0.4F));
            list.push_back({"CoatOnly" + at, coated(plastic(0.5F), 0.4F), cosine, false, {}, tilt,
                true, 2e-3});
        }
    return list;
}

}  // namespace

std::vector<BsdfFamily> bsdf_families()
{
    return {{"Lambert", {{"Lambert", white(0, 1)}}},
        {"Metal", at_all_angles("Metal", [](float r) { return white(1, r); })},
        {"Plastic", at_all_angles("Plastic", plastic)},
        {"Glass",
            at_all_angles(
                "Glass", [](float r) { return glass(r); }, 2e-3)},
        {"GlassInside",
            at_all_angles(
                "Glass", [](float r) { return glass(r); }, 2e-3, true)},
        {"Coated", at_all_angles("Coated", [](float r) { return coated(white(0, 1), r); })},
        {"Mixtures", mixtures()}, {"Leaning", leaning()}};
}

}  // namespace farlight
