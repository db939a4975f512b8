// Each lobe at all angles, mixtures, and normals that lean.
#include "lab/bsdf_cases.h"

#include "lab/lossless_materials.h"

#include <cmath>
#include <functional>

namespace farlight {
namespace {

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

/// From inside of glass: besides, just before and just beyond where all light is reflected. There
/// the table of albedos bends within one of its cells.
std::vector<BsdfCase> glass_inside()
{
    const auto glass = [](float roughness) { return lossless::glass(roughness); };
    std::vector<BsdfCase> list = at_all_angles("Glass", glass, 2e-3, true);
    for (const float roughness : {0.0F, 0.1F, 0.3F, 0.6F})
        for (const double off : {-1e-3, 1e-3})
            list.push_back({"GlassR" + std::to_string(std::lround(roughness * 1000))
                    + (off < 0 ? "BeyondTotal" : "BeforeTotal"),
                glass(roughness), std::sqrt(1 - 1 / 2.25) + off, true, {}, {}, true, 8e-3});
    return list;
}

/// Lobes of several kinds at once.
std::vector<BsdfCase> mixtures()
{
    Material half_metal = lossless::plastic(0.4F);
    half_metal.metallic = 0.5F;
    Material frosted_paint = lossless::glass(0.5F);
    frosted_paint.transmission = 0.4F;
    frosted_paint.metallic = 0.3F;
    Material thin_smooth = lossless::glass(0);
    thin_smooth.thin_walled = true;
    Material thin_rough = lossless::glass(0.5F);
    thin_rough.thin_walled = true;
    Material tinted = lossless::plastic(0.3F);
    tinted.specular_color = {1, 0.5F, 0.1F};
    tinted.specular = 0.7F;
    const Material all = lossless::coated(frosted_paint, 0.2F);
    return {{"HalfMetal", half_metal}, {"FrostedPaint", frosted_paint},
        {"FrostedPaintInside", frosted_paint, 0.7, true, {}, {}, true, 2e-3},
        {"ThinSmooth", thin_smooth}, {"ThinRough", thin_rough}, {"Tinted", tinted},
        {"Everything", all, 0.7, false, {}, {}, true, 2e-3},
        {"EverythingGrazing", all, 0.05, false, {}, {}, true, 2e-3},
        {"MirrorUnderCoat", lossless::coated(lossless::white(1, 0), 0.3F)},
        {"MirrorCoatOverRough", lossless::coated(lossless::plastic(0.4F), 0)},
        {"NoInterface", lossless::glass(0.5F, 1)},
        {"AlmostNoInterface", lossless::glass(0.5F, 1.003F), 0.7, false, {}, {}, true, 5e-3},
        {"Diamond", lossless::glass(0.3F, 2.42F), 0.7, false, {}, {}, true, 2e-3}};
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
            add("Lambert", lossless::white(0, 1));
            add("Metal", lossless::white(1, 0.4F));
            add("Plastic", lossless::plastic(0.5F));
            add("Glass", lossless::glass(0.4F));
            add("SmoothGlass", lossless::glass(0));
            add("Coated", lossless::coated(lossless::plastic(0.5F), 0.4F));
            list.push_back({"CoatOnly" + at, lossless::coated(lossless::plastic(0.5F), 0.4F),
                cosine, false, {}, tilt, true, 2e-3});
        }
    return list;
}

}  // namespace

std::vector<BsdfCase> bsdfs_of_rare_lobes()
{
    std::vector<BsdfCase> list;
    for (const float rare : {1e-2F, 1e-4F, 1e-7F, 1e-30F, 1e-42F})
        for (const double cosine : {1.0, 0.3, 1e-3}) {
            const std::string at = "1e" + std::to_string(std::lround(std::log10(rare))) + "C"
                + std::to_string(std::lround(cosine * 1000));
            const auto add = [&](const char* name, const Material& m, bool inside = false) {
                list.push_back({name + at, m, cosine, inside});
            };
            Material m = lossless::white(rare, 0.3F);
            add("RareMetal", m);
            m.metallic = 1 - std::max(rare, 1e-7F);
            add("RarePaint", m);
            m = lossless::plastic(0.2F);
            m.specular = rare;
            add("RareGloss", m);
            m.specular = 1;
            m.albedo = glm::vec3(rare, 0, 0);
            add("AlmostBlack", m);
            m = lossless::glass(0.3F);
            m.transmission = rare;
            add("RareGlass", m);
            m = lossless::glass(0.3F);
            m.albedo = glm::vec3(0, rare, 1);
            add("OneColorOfGlass", m, true);
            m.albedo = glm::vec3(0);
            m.specular = 0;
            add("Nothing", m);
            m = lossless::coated(lossless::white(1, 0.5F), 0.1F);
            m.clearcoat = rare;
            add("RareCoat", m);
        }
    return list;
}

std::vector<BsdfFamily> bsdf_families()
{
    return {{"Lambert", {{"Lambert", lossless::white(0, 1)}}},
        {"Metal", at_all_angles("Metal", [](float r) { return lossless::white(1, r); })},
        {"Plastic", at_all_angles("Plastic", lossless::plastic)},
        {"Glass",
            at_all_angles(
                "Glass", [](float r) { return lossless::glass(r); }, 2e-3)},
        {"GlassInside", glass_inside()},
        {"Coated",
            at_all_angles(
                "Coated", [](float r) { return lossless::coated(lossless::white(0, 1), r); })},
        {"Mixtures", mixtures()}, {"Leaning", leaning()}};
}

}  // namespace farlight
