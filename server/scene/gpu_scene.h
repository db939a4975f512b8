// GpuScene: a scene's tables in GPU buffers, by the names shaders use.
#pragma once

#include "server/gl/buffer.h"
#include "server/gl/shader_source.h"
#include "server/scene/packed_scene.h"
#include "server/scene/texture_arrays.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace farlight {

/// GPU memory by what it is for.
struct Allocation {
    std::string name;
    std::size_t bytes = 0;
};

class GpuScene {
public:
    /// Throws GlError naming buffer, limit and need when the scene is larger than the device
    /// allows.
    explicit GpuScene(const Scene& scene);

    /// Every buffer texture by the name shaders use. What the scene has nothing for shares one
    /// texel of zeros, so that a program with more effects than the scene finds all it binds.
    const std::map<std::string, GLuint, std::less<>>& textures() const { return textures_; }
    /// What shaders that see the scene are compiled with: one macro an effect, and BVH_STACK_SIZE.
    const Defines& defines() const { return defines_; }
    const std::vector<ActiveEffect>& effects() const { return effects_; }
    std::size_t triangle_count() const { return triangle_count_; }
    std::size_t light_count() const { return light_count_; }
    std::size_t dropped_triangles() const { return dropped_triangles_; }
    /// Every buffer but the shared texel of zeros.
    const std::vector<Allocation>& allocations() const { return allocations_; }
    std::size_t bytes() const;

private:
    void upload(const char* name, const Texels& texels);

    std::vector<Buffer> buffers_;
    std::unique_ptr<TextureArrays> images_;
    std::vector<Allocation> allocations_;
    std::map<std::string, GLuint, std::less<>> textures_;
    Defines defines_;
    std::vector<ActiveEffect> effects_;
    std::size_t triangle_count_ = 0;
    std::size_t light_count_ = 0;
    std::size_t dropped_triangles_ = 0;
};

}  // namespace farlight
