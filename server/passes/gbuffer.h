// G-buffer stage: what each pixel's ray meets first.
#pragma once

#include "server/passes/frame_inputs.h"

namespace farlight {

/// Texture contents: shaders/gbuffer/gbuffer.comp.
struct GBuffer {
    TextureHandle hit;
    TextureHandle surface;
    TextureHandle identity;
    TextureHandle position;
    TextureHandle albedo;
    TextureHandle emission;
    TextureHandle motion;
    TextureHandle reflectance;  ///< Only in scenes with something specular.
    TextureHandle fog_way;  ///< Only in fog.
    TextureHandle prev_surface;  ///< Last frame's; only with `keep_history`.
    TextureHandle prev_identity;
    TextureHandle prev_fog_way;
    bool surface_history_valid = false;
    bool fog_history_valid = false;
};

/// `keep_history`: a temporal filter will want last frame's surface and identity.
inline GBuffer gbuffer_textures(FrameGraph& graph, const FrameInputs& inputs, bool keep_history)
{
    GBuffer gbuffer;
    gbuffer.surface_history_valid = gbuffer.fog_history_valid = keep_history;
    const auto kept = [&](const char* name, GLenum format, TextureHandle& previous, bool& valid) {
        if (!keep_history)
            return graph.create(name, format);
        const History history = graph.history(name, format);
        previous = history.previous;
        valid = valid && history.valid;
        return history.current;
    };
    gbuffer.surface =
        kept("gbuffer.surface", GL_RGBA32UI, gbuffer.prev_surface, gbuffer.surface_history_valid);
    gbuffer.identity =
        kept("gbuffer.identity", GL_RGBA32UI, gbuffer.prev_identity, gbuffer.surface_history_valid);
    gbuffer.hit = graph.create("gbuffer.hit", GL_RGBA32UI);
    gbuffer.position = graph.create("gbuffer.position", GL_RGBA32F);
    gbuffer.albedo = graph.create("gbuffer.albedo", GL_RGBA32F);
    gbuffer.emission = graph.create("gbuffer.emission", GL_RGBA32F);
    gbuffer.motion = graph.create("gbuffer.motion", GL_RGBA32F);
    if (inputs.has_specular())
        gbuffer.reflectance = graph.create("gbuffer.reflectance", GL_RGBA32F);
    if (inputs.has_fog())
        gbuffer.fog_way =
            kept("gbuffer.fog_way", GL_R32F, gbuffer.prev_fog_way, gbuffer.fog_history_valid);
    return gbuffer;
}

inline GBuffer add_gbuffer(FrameGraph& graph, const FrameInputs& inputs, bool keep_history)
{
    const GBuffer gbuffer = gbuffer_textures(graph, inputs, keep_history);
    Pass& pass = graph.add_pass("gbuffer", "gbuffer/gbuffer.comp")
                     .scene(inputs.scene)
                     .write("out_hit", gbuffer.hit)
                     .write("out_surface", gbuffer.surface)
                     .write("out_identity", gbuffer.identity)
                     .write("out_position", gbuffer.position)
                     .write("out_albedo", gbuffer.albedo)
                     .write("out_emission", gbuffer.emission)
                     .write("out_motion", gbuffer.motion);
    inputs.add_primary_ray_constants(pass);
    if (inputs.has_specular())
        pass.write("out_reflectance", gbuffer.reflectance);
    if (inputs.has_fog()) {
        pass.write("out_fog_way", gbuffer.fog_way);
        inputs.add_fog_sphere(pass);
    }
    return gbuffer;
}

}  // namespace farlight
