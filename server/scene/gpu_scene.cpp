// Uploading.
#include "server/scene/gpu_scene.h"

#include "server/gl/gl_error.h"

#include <algorithm>

namespace farlight {

GpuScene::GpuScene(const Scene& scene)
{
    const PackedScene packed = pack_scene(scene, device_texture_limits());
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
        upload(name, *texels);
    images_ = std::make_unique<TextureArrays>(packed.textures);
    textures_.insert(images_->textures().begin(), images_->textures().end());
    for (const TextureArrays::Array& array : images_->arrays())
        allocations_.push_back({array.name, array.bytes});
}

void GpuScene::upload(const char* name, const Texels& texels)
{
    if (texels.empty()) {
        textures_[name] = buffers_.front().texture(GL_RGBA32UI);
        return;
    }
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    if (texels.size() > static_cast<std::size_t>(limit))
        throw GlError("the scene needs " + std::to_string(texels.size()) + " texels for '" + name
            + "', but this device allows " + std::to_string(limit) + " in a buffer texture");
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
