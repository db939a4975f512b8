// relMSE, as client/metrics/metrics.h defines it.
#pragma once

// What a pixel's error is divided by before it is squared.
vec3 relative_scale(vec3 reference) { return inversesqrt(reference * reference + 0.01); }

// Of one pixel that is `error` off `reference`, as part of a mean over pixels. Source: Rousselle et al. 2011.
float relative_square(vec3 error, vec3 reference)
{
    const vec3 relative = error * error / (reference * reference + 0.01);
    return (relative.r + relative.g + relative.b) / 3.0;
}

// Likewise where the expected squares of the errors are known.
float relative_variance(vec3 variance, vec3 reference)
{
    const vec3 relative = variance / (reference * reference + 0.01);
    return (relative.r + relative.g + relative.b) / 3.0;
}
