// What the stages of one frame may know of the scene and its camera, and the constants that follow
// from it.
#pragma once

#include "server/render/frame_graph.h"

namespace farlight {

/// Homogeneous fog in a sphere (shaders/media/fog.glsl); sigma_t 0: none.
struct Fog {
    glm::vec3 sigma_t{0};  ///< Extinction [1/m].
    glm::vec3 sigma_s{0};  ///< Scattering [1/m].
    float g = 0;
    glm::vec3 center{0};
    float radius = 1;
};

struct FrameInputs {
    const SceneInputs& scene;
    Fog fog;
    float lens_radius = 0;  ///< [m], 0: pinhole.
    float focus_distance = 1;  ///< View depth [m], > 0.
    glm::vec2 pixel_jitter{0};  ///< Of the primary rays from the pixels' middles [px].
    bool holes = false;  ///< Some surface is not there everywhere: rays go on through it.

    /// The same, for another variant of the scene's programs.
    FrameInputs with_scene(const SceneInputs& other) const
    {
        return {other, fog, lens_radius, focus_distance, pixel_jitter, holes};
    }

    bool has_specular() const { return scene.calls_for("FX_SPECULAR_SIGNAL"); }
    bool has_fog() const { return scene.calls_for("FX_FOG"); }
    bool has_lens() const { return scene.calls_for("FX_LENS"); }

    /// For passes that shoot or rebuild primary rays (lib/primary_ray.glsl).
    void add_primary_ray_constants(Pass& pass) const
    {
        if (has_lens())
            add_lens_constants(pass);
        if (scene.calls_for("FX_ANTIALIASING"))
            pass.constant("pixel_jitter", pixel_jitter);
    }
    void add_lens_constants(Pass& pass) const
    {
        pass.constant("lens_radius", lens_radius).constant("focus_distance", focus_distance);
    }
    /// The sphere, for passes that measure ways through fog.
    void add_fog_sphere(Pass& pass) const
    {
        pass.constant("fog_center", fog.center).constant("fog_radius", fog.radius);
    }
};

}  // namespace farlight
