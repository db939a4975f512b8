// GpuScene: a scene's tables in GPU buffers, by the names shaders use.
#pragma once

#include "server/gl/buffer.h"
#include "server/gl/shader_source.h"
#include "server/scene/device_limits.h"
#include "server/scene/insides.h"
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
    /// At time 0. Throws GlError naming buffer, limit and need when the scene is larger than
    /// `limits` allow. Of `scene` everything but meshes and images must outlive this.
    explicit GpuScene(const Scene& scene, const DeviceLimits& limits = device_limits());

    /// Brings what moves to `time` and its past to `prev_time` [s]; costs nothing when neither has
    /// changed: false. Frames that are drawn after it see it, frames before it do not. A wide scene
    /// is counted from `origin`, others ignore it.
    bool pose(double time, double prev_time, const glm::dvec3& origin = glm::dvec3(0));
    /// Whether it is counted from near each frame's camera (scene_origin.h).
    bool wide() const { return moving_->wide(); }
    /// Whether anything depends on time.
    bool moves() const { return !scene_.animation.empty(); }
    double moment_shown(double time) const
    {
        return farlight::moment_shown(scene_.animation, time);
    }
    /// Factor on the scene's background now.
    float background_factor() const { return background_factor_; }

    /// What a point is inside of now, counted from the scene's origin.
    Insides::Filling filling_at(const glm::dvec3& point) const
    {
        return insides_.at(point, moving_->world_from_node());
    }

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
    void upload(const char* name, const Texels& texels, const DeviceLimits& limits);
    void update(const char* name, const Texels& texels, std::size_t first_texel = 0);
    void update_now();
    void update_lights();

    const Scene& scene_;
    Insides insides_;
    std::optional<MovingScene> moving_;
    std::optional<LightTable> lights_;
    Texels materials_;  ///< Without the factors of tracks.
    double time_ = 0;
    glm::dvec3 origin_{0};
    float background_factor_ = 1;
    std::vector<Buffer> buffers_;
    std::map<std::string, std::size_t, std::less<>> buffer_of_;  ///< Index into buffers_.
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
