// Reference: glTF 2.0 specification, section 3.9, and the KHR_materials extensions named below.
// Light is photometric there and radiometric here: one nit is read as one W/(m^2 sr).
#include "server/scene/gltf_material.h"

#include "server/scene/gltf_texture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// As in a Farlight scene: its square is still a finite float.
constexpr double kLargestRadiance = 1e18;
constexpr double kLargestIor = 100;  // reflects 96 %; keeps squares and ratios well inside a float
constexpr double kLargestAbsorption = 1e9;  // [1/m]: a nanometre is dark
/// Stands for an attenuation colour of 0, whose logarithm has no bound: darker than 16 bits show.
constexpr double kDarkest = 1e-6;

/// One material. Each read_* names the extension or the part of the core that it reads.
class MaterialReader {
public:
    MaterialReader(GltfTextures& textures, const Json& json, const ScenePlace& place)
        : textures_(textures)
        , json_(json)
        , place_(place)
    {
    }

    Material read()
    {
        material_ = default_gltf_material();
        read_metallic_roughness();
        read_surface();
        read_emission();
        with("KHR_materials_ior", &MaterialReader::read_ior);
        with("KHR_materials_specular", &MaterialReader::read_specular);
        with("KHR_materials_transmission", &MaterialReader::read_transmission);
        with("KHR_materials_volume", &MaterialReader::read_volume);
        with("KHR_materials_clearcoat", &MaterialReader::read_clearcoat);
        material_.unlit = gltf_extension(json_, "KHR_materials_unlit") != nullptr;
        return std::move(material_);
    }

    std::size_t changed() const { return changed_; }

private:
    using ReadExtension = void (MaterialReader::*)(const Json&, const ScenePlace&);

    void with(const char* extension, ReadExtension read_extension)
    {
        if (const Json* found = gltf_extension(json_, extension))
            (this->*read_extension)(*found, place_ / "extensions" / extension);
    }

    double kept(double value, double least, double most)
    {
        const double inside = std::clamp(value, least, most);
        changed_ += inside == value ? 0 : 1;
        return inside;
    }

    float factor(const Json& owner, const char* key, double fallback, double most = 1)
    {
        return static_cast<float>(kept(owner.value(key, fallback), 0, most));
    }

    /// Farther from 1 than this, the other axes do not count any more.
    float normal_scale(const Json& texture)
    {
        return static_cast<float>(kept(texture.value("scale", 1.0), -1000, 1000));
    }

    glm::vec3 color(const Json& owner, const char* key, double fallback, double scale, double most)
    {
        glm::dvec3 color(fallback);
        if (const auto found = owner.find(key); found != owner.end())
            for (int i = 0; i < 3; ++i)
                color[i] = (*found)[static_cast<std::size_t>(i)].get<double>() * scale;
        const glm::dvec3 inside = glm::clamp(color, 0.0, most);
        changed_ += inside == color ? 0 : 1;
        return inside;
    }

    void read_metallic_roughness();
    void read_surface();
    void read_emission();
    void read_ior(const Json& ior, const ScenePlace& place);
    void read_specular(const Json& specular, const ScenePlace& place);
    void read_transmission(const Json& transmission, const ScenePlace& place);
    void read_volume(const Json& volume, const ScenePlace& place);
    void read_clearcoat(const Json& clearcoat, const ScenePlace& place);

    GltfTextures& textures_;
    const Json& json_;
    ScenePlace place_;
    Material material_;
    std::size_t changed_ = 0;
};

void MaterialReader::read_metallic_roughness()
{
    const auto found = json_.find("pbrMetallicRoughness");
    if (found == json_.end())
        return;
    const Json& pbr = *found;
    const ScenePlace place = place_ / "pbrMetallicRoughness";
    material_.albedo = color(pbr, "baseColorFactor", 1, 1, 1);
    if (pbr.contains("baseColorFactor"))
        material_.opacity = static_cast<float>(kept(pbr["baseColorFactor"][3].get<double>(), 0, 1));
    material_.albedo_texture = textures_.read(pbr, "baseColorTexture", place);
    material_.metallic = factor(pbr, "metallicFactor", 1);
    material_.roughness = factor(pbr, "roughnessFactor", 1);
    material_.metallic_roughness_texture = textures_.read(pbr, "metallicRoughnessTexture", place);
}

void MaterialReader::read_surface()
{
    material_.normal_texture = textures_.read(json_, "normalTexture", place_);
    if (material_.normal_texture.used())
        material_.normal_scale = normal_scale(json_["normalTexture"]);
    const std::string mode = json_.value("alphaMode", "OPAQUE");
    material_.alpha_mode = mode == "MASK" ? AlphaMode::kMask
        : mode == "BLEND"                 ? AlphaMode::kBlend
                                          : AlphaMode::kOpaque;
    material_.alpha_cutoff = factor(json_, "alphaCutoff", 0.5, std::numeric_limits<float>::max());
    material_.emits_both_sides = json_.value("doubleSided", false);
}

void MaterialReader::read_emission()
{
    double strength = 1;
    if (const Json* found = gltf_extension(json_, "KHR_materials_emissive_strength"))
        strength = found->value("emissiveStrength", 1.0);
    material_.emission = color(json_, "emissiveFactor", 0, strength, kLargestRadiance);
    material_.emission_texture = textures_.read(json_, "emissiveTexture", place_);
}

void MaterialReader::read_ior(const Json& ior, const ScenePlace& /*place*/)
{
    const double value = ior.value("ior", 1.5);
    // 0 stands for a reflectance of 1 at all angles, as much of it as an index can give.
    material_.ior = static_cast<float>(value == 0 ? kLargestIor : kept(value, 1, kLargestIor));
}

void MaterialReader::read_specular(const Json& specular, const ScenePlace& place)
{
    material_.specular = factor(specular, "specularFactor", 1);
    material_.specular_texture = textures_.read(specular, "specularTexture", place);
    material_.specular_color =
        color(specular, "specularColorFactor", 1, 1, std::numeric_limits<float>::max());
    material_.specular_color_texture = textures_.read(specular, "specularColorTexture", place);
}

void MaterialReader::read_transmission(const Json& transmission, const ScenePlace& place)
{
    material_.transmission = factor(transmission, "transmissionFactor", 0);
    material_.transmission_texture = textures_.read(transmission, "transmissionTexture", place);
    material_.thin_walled = material_.transmission > 0;
}

/// Thickness is an approximation for who draws without rays: only whether there is any counts.
void MaterialReader::read_volume(const Json& volume, const ScenePlace& /*place*/)
{
    if (!(volume.value("thicknessFactor", 0.0) > 0))
        return;
    material_.thin_walled = false;
    const double distance = volume.value("attenuationDistance", 0.0);
    if (!(distance > 0))  // absent: endless
        return;
    const glm::dvec3 seen = color(volume, "attenuationColor", 1, 1, 1);
    for (int i = 0; i < 3; ++i)
        material_.absorption[i] = static_cast<float>(
            std::min(-std::log(std::max(seen[i], kDarkest)) / distance, kLargestAbsorption));
}

void MaterialReader::read_clearcoat(const Json& clearcoat, const ScenePlace& place)
{
    material_.clearcoat = factor(clearcoat, "clearcoatFactor", 0);
    material_.clearcoat_texture = textures_.read(clearcoat, "clearcoatTexture", place);
    material_.clearcoat_roughness = factor(clearcoat, "clearcoatRoughnessFactor", 0);
    material_.clearcoat_roughness_texture =
        textures_.read(clearcoat, "clearcoatRoughnessTexture", place);
    material_.clearcoat_normal_texture = textures_.read(clearcoat, "clearcoatNormalTexture", place);
    if (material_.clearcoat_normal_texture.used())
        material_.clearcoat_normal_scale = normal_scale(clearcoat["clearcoatNormalTexture"]);
}

}  // namespace

Material default_gltf_material()
{
    return {
        .name = "default", .albedo = glm::vec3(1), .metallic = 1, .roughness = 1, .specular = 1};
}

void read_gltf_materials(const GltfContainer& gltf, Scene& scene)
{
    GltfTextures textures(gltf);
    std::size_t changed = 0;
    const Json& materials = gltf.list("materials");
    for (std::size_t i = 0; i < materials.size(); ++i) {
        MaterialReader reader(textures, materials[i], gltf.root / "materials" / i);
        Material material = reader.read();
        material.name = materials[i].value("name", "");
        if (material.name.empty())
            material.name = "material " + std::to_string(i);
        scene.materials.push_back(std::move(material));
        changed += reader.changed();
    }
    scene.images = textures.take_images();
    for (std::string& note : textures.notes())
        scene.notes.push_back(std::move(note));
    if (changed > 0)
        scene.notes.push_back(
            std::to_string(changed) + " material factors outside their range clamped");
}

}  // namespace farlight
