// What sampling a light gives to a shading point.
#pragma once

struct LightSample {
    vec3 wi;       // unit, from the shading point to the light
    float pdf;     // per solid angle [1/sr], 0: nothing was sampled; `delta`: probability of the light
    vec3 radiance;  // that arrives along wi if nothing is between; `delta`: irradiance on what faces the light
    bool delta;    // from a light without extent, which no other sampling can find: its MIS weight is 1
    bool infinite;  // the shadow ray goes on for ever along wi; otherwise it ends at `position`
    vec3 position;  // on the light [m]
    vec3 normal;    // the light's own, unit; 0: it has none
    float offset;   // how far off the light along its normal the shadow ray must end [m]
};

const LightSample NO_LIGHT_SAMPLE
    = LightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), false, false, vec3(0.0), vec3(0.0), 0.0);
