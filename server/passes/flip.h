// FLIP stage: the difference between two pictures on a screen as a person sees it who alternates
// them, for 67 pixels a degree. client/metrics/flip.h is the same on the host.
#pragma once

#include "server/passes/tonemap.h"

namespace farlight {

/// What FLIP looks at of one picture (shaders/flip/filter.comp).
struct FlipPicture {
    TextureHandle seen;
    TextureHandle points;
};

/// `name` tells the two pictures apart.
inline FlipPicture add_flip_picture(FrameGraph& graph, const std::string& name,
    TextureHandle radiance, const RenderSettings& settings)
{
    const TextureHandle opponent = graph.create("flip.opponent", GL_RGBA32F);
    Pass& shown = graph.add_pass("flip opponent " + name, "flip/opponent.comp")
                      .read("in_radiance", radiance)
                      .write("out_opponent", opponent);
    add_tone_constants(shown, settings);

    const TextureHandle rows = graph.create("flip.rows", GL_RGBA32F);
    const TextureHandle row_features = graph.create("flip.row_features", GL_RGBA32F);
    graph.add_pass("flip rows " + name, "flip/filter.comp")
        .read("in_opponent", opponent)
        .write("out_seen", rows)
        .write("out_features", row_features);

    const FlipPicture picture{
        graph.create("flip.seen", GL_RGBA32F), graph.create("flip.points", GL_R32F)};
    graph.add_pass("flip columns " + name, "flip/filter.comp")
        .define({{"DOWN", "1"}})
        .read("in_seen", rows)
        .read("in_features", row_features)
        .write("out_seen", picture.seen)
        .write("out_points", picture.points);
    return picture;
}

/// Error of each pixel in [0, 1] (r32f). Both pictures are scene-linear. `keeps`: last frame's map
/// once more, if there is one.
inline TextureHandle add_flip(FrameGraph& graph, TextureHandle test, TextureHandle reference,
    const RenderSettings& settings, bool keeps)
{
    const History map = graph.history("flip.map", GL_R32F);
    if (keeps && map.valid) {
        graph.add_pass("flip keep", "flip/keep.comp")
            .read("prev_map", map.previous)
            .write("out_map", map.current);
        return map.current;
    }
    const FlipPicture x = add_flip_picture(graph, "picture", test, settings);
    const FlipPicture r = add_flip_picture(graph, "mean", reference, settings);
    graph.add_pass("flip compare", "flip/compare.comp")
        .read("test_seen", x.seen)
        .read("test_points", x.points)
        .read("reference_seen", r.seen)
        .read("reference_points", r.points)
        .write("out_map", map.current);
    return map.current;
}

}  // namespace farlight
