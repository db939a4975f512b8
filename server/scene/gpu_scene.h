// GpuScene: a Scene flattened to world space, with its tree and lights, in GPU buffers.
#pragma once

#include "server/gl/buffer.h"
#include "server/gl/shader_source.h"
#include "server/scene/bvh.h"
#include "server/scene/effects.h"
#include "server/scene/lights.h"
#include "server/scene/scene.h"

#include <map>
#include <string>
#include <vector>

namespace farlight {

/// The scene as arrays of 16-byte texels (shaders/shared/scene_layout.h), still on the CPU.
struct PackedScene {
    std::vector<glm::uvec4> bvh_nodes;
    std::vector<glm::uvec4> triangles;
    std::vector<glm::uvec4> spheres;
    std::vector<glm::uvec4> primitives;
    std::vector<glm::uvec4> materials;
    std::vector<glm::uvec4> lights;
    SceneContent content;
    std::size_t dropped_triangles = 0;  ///< Zero area or not finite once in world space.
    int stack_depth = 0;

    std::size_t light_count() const { return content.polygon_lights + content.sphere_lights; }
};

/// Flattens instances, builds the tree and the light table. Needs no GL.
PackedScene pack_scene(const Scene& scene);

class GpuScene {
public:
    /// Throws GlError naming buffer, limit and need when the scene is larger than the device
    /// allows.
    explicit GpuScene(const Scene& scene);

    /// Every buffer texture by the name shaders use.
    const std::map<std::string, GLuint, std::less<>>& textures() const { return textures_; }
    /// What shaders that see the scene are compiled with: one macro an effect, and BVH_STACK_SIZE.
    const Defines& defines() const { return defines_; }
    const std::vector<ActiveEffect>& effects() const { return effects_; }
    std::size_t triangle_count() const { return triangle_count_; }
    std::size_t light_count() const { return light_count_; }
    std::size_t dropped_triangles() const { return dropped_triangles_; }
    std::size_t bytes() const;

private:
    void upload(const std::string& name, const std::vector<glm::uvec4>& texels);

    std::vector<Buffer> buffers_;
    std::map<std::string, GLuint, std::less<>> textures_;
    Defines defines_;
    std::vector<ActiveEffect> effects_;
    std::size_t triangle_count_ = 0;
    std::size_t light_count_ = 0;
    std::size_t dropped_triangles_ = 0;
};

}  // namespace farlight
