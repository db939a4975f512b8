// Uploading, and bringing up to date what moves.
#include "server/scene/gpu_scene.h"

#include "server/gl/gl_error.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>

namespace farlight {

namespace {

/// Factors of the tracks that drive `target`, one an index; none where no track does.
std::vector<float> factors_at(
    const Animation& animation, Track::Target target, std::size_t count, double time)
{
    std::vector<float> factors;
    if (drives(animation, target))
        for (std::uint32_t i = 0; i < count; ++i)
            factors.push_back(static_cast<float>(factor_at(animation, target, i, time)));
    return factors;
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, const DeviceLimits& limits) : scene_(scene), insides_(scene)
{
    PackedScene packed = pack_scene(scene, limits.textures);
    effects_ = packed.effects;
    triangle_count_ = packed.content.triangles;
    light_count_ = packed.lights->count();
    dropped_triangles_ = packed.dropped_triangles;
    for (const std::string_view macro : mask_of(effects_).macros())
        defines_.emplace_back(macro, "1");
    defines_.emplace_back("BVH_STACK_SIZE", std::to_string(packed.stack_depth + 1));
    defines_.emplace_back("TEXTURE_ARRAY_COUNT",
        std::to_string(std::max<std::size_t>(packed.textures.arrays().size(), 1)));
    buffers_.emplace_back("nothing", std::span<const std::byte>());
    for (const auto& [name, texels] : packed.tables())
        upload(name, *texels, limits);
    images_ = std::make_unique<TextureArrays>(packed.textures);
    textures_.insert(images_->textures().begin(), images_->textures().end());
    for (const TextureArrays::Array& array : images_->arrays())
        allocations_.push_back({array.name, array.bytes});
    materials_ = std::move(packed.materials);
    moving_.emplace(std::move(*packed.moving));
    lights_.emplace(std::move(*packed.lights));
    if (!scene.animation.empty())
        update_lights();
}

bool GpuScene::pose(double time, double prev_time, const glm::dvec3& origin)
{
    if (!moves() && !wide())
        return false;
    origin_ = wide() ? origin : glm::dvec3(0);
    const MovingScene::Changes changes = moving_->pose(time, prev_time, origin_);
    time_ = time;
    if (changes.now)
        update_now();
    if (changes.previous) {
        update("prev_instances", moving_->prev_instances());
        update("prev_vertices", moving_->deforming().prev_vertices);
    }
    return changes.now || changes.previous;
}

void GpuScene::update_now()
{
    const DeformingTables& deforming = moving_->deforming();
    update("bvh_nodes", moving_->top_level());
    update("instances", moving_->instances());
    update("bvh_nodes", deforming.bvh_nodes, deforming.first_node);
    update(
        "triangles", deforming.triangles, deforming.first_triangle * std::size_t{TRIANGLE_TEXELS});
    update("normals", deforming.normals, deforming.first_triangle);
    update("tangents", deforming.tangents, deforming.first_triangle);
    update_lights();
}

/// Lights where they are, as strong as they are; what emits shows as much as is sampled of it.
void GpuScene::update_lights()
{
    const Animation& animation = scene_.animation;
    const auto emission =
        factors_at(animation, Track::Target::kMaterialEmission, scene_.materials.size(), time_);
    const auto intensity =
        factors_at(animation, Track::Target::kLightIntensity, scene_.lights.size(), time_);
    background_factor_ =
        static_cast<float>(factor_at(animation, Track::Target::kBackground, 0, time_));
    lights_->update(moving_->lights(),
        {emission, intensity, moving_->world_from_node(), background_factor_, origin_});
    update("lights", lights_->lights());
    update("light_tree", lights_->tree());
    if (emission.empty())
        return;
    Texels materials = materials_;
    for (std::size_t i = 0; i < emission.size(); ++i) {
        glm::uvec4& target = materials[i * MATERIAL_TEXELS + MATERIAL_EMISSION];
        target = texel(glm::uintBitsToFloat(glm::uvec3(target)) * emission[i], target.w);
    }
    update("materials", materials);
}

void GpuScene::update(const char* name, const Texels& texels, std::size_t first_texel)
{
    if (!texels.empty())
        buffers_[buffer_of_.at(name)].update(
            std::as_bytes(std::span<const glm::uvec4>(texels)), first_texel * sizeof texels[0]);
}

void GpuScene::upload(const char* name, const Texels& texels, const DeviceLimits& limits)
{
    if (texels.empty()) {
        textures_[name] = buffers_.front().texture(GL_RGBA32UI);
        return;
    }
    if (texels.size() > limits.buffer_texels)
        throw GlError("the scene needs " + std::to_string(texels.size()) + " texels for '" + name
            + "', but this device allows " + std::to_string(limits.buffer_texels)
            + " in a buffer texture");
    buffer_of_[name] = buffers_.size();
    buffers_.emplace_back(name, std::as_bytes(std::span<const glm::uvec4>(texels)));
    textures_[name] = buffers_.back().texture(GL_RGBA32UI);
    allocations_.push_back({name, buffers_.back().size()});
    check_gl(std::string("uploading '") + name + "'");
}

std::size_t GpuScene::bytes() const
{
    std::size_t sum = 0;
    for (const Allocation& allocation : allocations_)
        sum += allocation.bytes;
    return sum;
}

}  // namespace farlight
