// How long a history a pixel has, in double precision: the oracle of the temporal filter, from what
// two frames saw.
#pragma once

#include "lab/device_scene.h"

namespace farlight::lab {

constexpr Extent kRemembered{64, 48};
constexpr int kLongest = 6;  ///< history_max of the requests below [frames].

/// What the oracle knows of a frame: of each pixel where its surface is, how it lies, and whose it
/// is.
struct Seen {
    CameraPose camera;
    Image position;
    Image geometric_normal;
    Image shading_normal;
    Image object;
};

RenderRequest request_of(const Scene& scene, const CameraPose& camera, DebugView which);
Seen seen_from(const DeviceScene& scene, const CameraPose& camera);
bool met(const Seen& seen, int x, int y);
/// Whether the 3x3 pixels around show one thing and no edge of the frame.
bool away_from_edges(const Seen& seen, int x, int y);

/// Of each pixel [frames], 0 where nothing is met.
using Lengths = std::vector<int>;
int& at(Lengths& lengths, int x, int y);

/// The history of pixel (x, y), in double precision: one more than the least of the four pixels
/// around where its surface was, of those that show it; else of the nine around.
int length_of(const Seen& now, const Seen& before, Lengths& old, int x, int y);

}  // namespace farlight::lab
