// Factors only: textures, metalness and roughness are not read.
#include "server/scene/gltf_material.h"

#include <algorithm>
#include <tiny_gltf.h>

namespace farlight {

namespace {

/// As in a Farlight scene: its square is still a finite float.
constexpr double kLargestRadiance = 1e18;

/// KHR_materials_emissive_strength; 1 without it.
double emissive_strength(const tinygltf::Material& material)
{
    const auto extension = material.extensions.find("KHR_materials_emissive_strength");
    if (extension == material.extensions.end() || !extension->second.Has("emissiveStrength"))
        return 1;
    return extension->second.Get("emissiveStrength").GetNumberAsDouble();
}

/// The first three factors times `scale`, brought into [0, most]; counts in `changed` if needed.
glm::vec3 color(const std::vector<double>& factors, double scale, double most, std::size_t& changed)
{
    glm::dvec3 value(0);
    for (std::size_t i = 0; i < 3 && i < factors.size(); ++i)
        value[static_cast<int>(i)] = factors[i] * scale;
    const glm::dvec3 kept = glm::clamp(value, 0.0, most);
    if (kept != value)
        ++changed;
    return kept;
}

}  // namespace

std::vector<Material> read_gltf_materials(
    const tinygltf::Model& model, std::vector<std::string>& notes)
{
    std::vector<Material> materials;
    std::size_t changed = 0;
    std::size_t see_through = 0;
    for (const tinygltf::Material& found : model.materials) {
        Material& material = materials.emplace_back();
        material.name =
            found.name.empty() ? "material " + std::to_string(materials.size() - 1) : found.name;
        material.albedo = color(found.pbrMetallicRoughness.baseColorFactor, 1, 1, changed);
        material.emission =
            color(found.emissiveFactor, emissive_strength(found), kLargestRadiance, changed);
        material.emits_both_sides = found.doubleSided;
        see_through += found.alphaMode == "OPAQUE" ? 0 : 1;
    }
    if (changed > 0)
        notes.push_back(std::to_string(changed)
            + " colour factors outside their range clamped: albedo to [0, 1], emission to 0 or "
              "more");
    if (see_through > 0)
        notes.push_back(std::to_string(see_through) + " see-through materials are drawn opaque");
    return materials;
}

}  // namespace farlight
