// media/fog.glsl: distances and directions against their densities and closed forms.
#version 450
#include "expect.glsl"
#include "media/fog.glsl"

const int N = 2048;

// Loops run to a number the compiler does not know, or it would unroll them for seconds.
int up_to(int n) { return results.length() > 0 ? n : 0; }

Fog fog_of(vec3 sigma_a, vec3 sigma_s, float g) { return Fog(sigma_a + sigma_s, sigma_s, g, vec3(0.0), 10.0); }

// Midpoint rule over u: the mean of a weight is the integral it stands for.
void test_free_path(Fog fog, float length)
{
    vec3 scattered = vec3(0.0);
    vec3 passed = vec3(0.0);
    vec3 within = vec3(0.0);
    for (int i = 0; i < up_to(N); ++i)
        for (int c = 0; c < up_to(3); ++c) {
            const vec2 u = vec2((float(i) + 0.5) / float(N), (float(c) + 0.5) / 3.0);
            const FogEvent e = sample_fog(fog, length, u);
            EXPECT_LE(e.way, length);
            EXPECT_TRUE(all_finite(e.weight));
            if (e.scattered)
                scattered += e.weight;
            else
                passed += e.weight;
            const FogEvent w = sample_fog_within(fog, length, u);
            EXPECT_LE(w.way, length);
            within += w.weight;
        }
    const vec3 transmittance = exp(-fog.sigma_t * length);
    // integral of sigma_s exp(-sigma_t t) over the way; without extinction sigma_s * length
    for (int c = 0; c < up_to(3); ++c) {
        const float expected = fog.sigma_t[c] > 0.0
            ? fog.sigma_s[c] / fog.sigma_t[c] * one_minus_exp(fog.sigma_t * length)[c]
            : 0.0;
        // One of 3 * 2048 points at the jump between scattered and passed, times the largest weight: 3 / 6144.
        EXPECT_NEAR(scattered[c] / float(3 * N), expected, 5e-4);
        EXPECT_NEAR(passed[c] / float(3 * N), transmittance[c], 5e-4);
        // Each weight is the mean of three densities' ratios, smooth: 1e-3 is the midpoint rule's error at sigma 40.
        EXPECT_NEAR(within[c] / float(3 * N), expected, 1e-3 * expected);
    }
}

void test_weights_are_bounded()
{
    const Fog grey = fog_of(vec3(0.0), vec3(0.7), 0.0);
    for (int i = 0; i < up_to(256); ++i) {
        const FogEvent e = sample_fog(grey, 3.0, vec2(float(i) / 256.0, 0.1));
        EXPECT_NEAR(e.weight.x, 1.0, 1e-6);  // nothing is absorbed: every path carries all of it
    }
    // Extinctions from next to nothing to complete, one channel empty: no weight beyond 3, one a channel.
    for (int k = -20; k <= up_to(20); ++k) {
        const float sigma = exp2(float(2 * k));
        const Fog fog = fog_of(vec3(0.0), vec3(sigma, 0.5 * sigma, 0.0), 0.0);
        for (int i = 0; i < up_to(30); ++i) {
            const vec2 u = vec2(float(i) / 30.0, (float(i % 3) + 0.5) / 3.0);
            const FogEvent e = sample_fog(fog, 1.0, u);
            const FogEvent w = sample_fog_within(fog, 1.0, u);
            EXPECT_TRUE(all_finite(e.weight) && all_finite(w.weight));
            EXPECT_LE(max_component(e.weight), 3.0001);
            EXPECT_LE(max_component(w.weight), 3.0001);
        }
    }
}

// The phase function integrates to one, its mean cosine is g, and sampling follows it: 32 bins of equal cosine.
void test_phase(float g)
{
    const Fog fog = fog_of(vec3(0.0), vec3(1.0), g);
    float sum = 0.0, mean = 0.0, sampled_mean = 0.0;
    float expected[32];
    float found[32];
    for (int bin = 0; bin < up_to(32); ++bin)
        expected[bin] = found[bin] = 0.0;
    for (int i = 0; i < up_to(N); ++i) {
        const float cosine = 2.0 * (float(i) + 0.5) / float(N) - 1.0;
        const float p = fog_phase(fog, cosine) * 4.0 * PI / float(N);
        sum += p;
        mean += p * cosine;
        expected[i * 32 / N] += p;
        const vec3 axis = normalize(vec3(0.3, -0.5, 0.8));
        const vec3 way = sample_fog_phase(fog, axis, vec2((float(i) + 0.5) / float(N), fract(float(i) * 0.618034)));
        EXPECT_NEAR(length(way), 1.0, 1e-6);
        const float sampled = dot(way, axis);
        sampled_mean += sampled / float(N);
        found[clamp(int((sampled + 1.0) * 16.0), 0, 31)] += 1.0 / float(N);
    }
    // Midpoint rule of a peak as sharp as |g| = 0.9: 2e-3; two points at a bin's ends: 2 / N.
    EXPECT_NEAR(sum, 1.0, 2e-3);
    EXPECT_NEAR(mean, g, 2e-3);
    EXPECT_NEAR(sampled_mean, g, 1e-3);
    for (int bin = 0; bin < up_to(32); ++bin)
        EXPECT_NEAR(found[bin], expected[bin], 2.0 / float(N) + 2e-3);
}

void test_span()
{
    const Fog fog = Fog(vec3(1.0), vec3(1.0), 0.0, vec3(1.0, 0.0, 0.0), 2.0);
    const vec3 x = vec3(1.0, 0.0, 0.0);
    EXPECT_NEAR(fog_span(fog, vec3(-4.0, 0.0, 0.0), x, 1e30).x, 3.0, 1e-5);
    EXPECT_NEAR(fog_span(fog, vec3(-4.0, 0.0, 0.0), x, 1e30).y, 7.0, 1e-5);
    EXPECT_NEAR(fog_span(fog, vec3(0.0), x, 1e30).x, 0.0, 0.0);
    EXPECT_NEAR(fog_span(fog, vec3(0.0), x, 0.5).y, 0.5, 0.0);
    const vec2 beside = fog_span(fog, vec3(-4.0, 2.1, 0.0), x, 1e30);
    EXPECT_EQ(beside.x, beside.y);
    const vec2 behind = fog_span(fog, vec3(4.0, 0.0, 0.0), x, 1e30);
    EXPECT_EQ(behind.x, behind.y);
}

void main()
{
    const Fog fogs[4] = Fog[](fog_of(vec3(0.0), vec3(0.5), 0.0), fog_of(vec3(0.1, 0.0, 0.3), vec3(0.2, 0.5, 1.0), 0.0),
        fog_of(vec3(0.0), vec3(1e-6, 1e-5, 2e-5), 0.0), fog_of(vec3(0.0), vec3(1.0, 0.0, 40.0), 0.0));
    for (int i = 0; i < up_to(4); ++i)
        test_free_path(fogs[i], 1.0 + 0.7 * float(i));
    test_weights_are_bounded();
    const float means[5] = float[](0.0, 1e-5, -0.3, 0.8, -0.9);
    for (int i = 0; i < up_to(5); ++i)
        test_phase(means[i]);
    test_span();
}
