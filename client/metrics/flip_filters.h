// What FLIP filters out of a picture in its opponent space YCxCz.
#pragma once

#include "client/metrics/separable.h"

namespace farlight::client {

/// Y, Cx and Cz.
struct Planes {
    Plane x, y, z;
};

/// Strengths of edges and points.
struct Features {
    Plane edges, points;
};

/// Each channel as the eye resolves it.
Planes seen(const Planes& opponent, ImageSize size, double pixels_per_degree);

Features features_of(const Planes& opponent, ImageSize size, double pixels_per_degree);

}  // namespace farlight::client
