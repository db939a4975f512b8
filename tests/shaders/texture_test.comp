// textures/texture.glsl: wraps and texel centres worked out by hand, without any image.
#version 450
#define FX_TEXTURES
#define TEXTURE_ARRAY_COUNT 1
#include "expect.glsl"
#include "textures/texture.glsl"

TextureRef plain(uint wrap, ivec2 size)
{
    return TextureRef(true, false, 0u, 0, 0, uvec2(wrap), size, vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(0.0));
}

void test_wrap_coordinate()
{
    const float x[6] = float[](-1.25, -0.25, 0.25, 1.25, 2.25, 3.5);
    const float repeated[6] = float[](0.75, 0.75, 0.25, 0.25, 0.25, 0.5);
    const float mirrored[6] = float[](0.75, 0.25, 0.25, 0.75, 0.25, 0.5);
    const float clamped[6] = float[](0.0, 0.0, 0.25, 1.0, 1.0, 1.0);
    for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(wrap_coordinate(plain(TEXTURE_REPEAT, ivec2(4)), vec2(x[i])).x, repeated[i], 1e-6);
        EXPECT_NEAR(wrap_coordinate(plain(TEXTURE_MIRROR, ivec2(4)), vec2(x[i])).y, mirrored[i], 1e-6);
        EXPECT_NEAR(wrap_coordinate(plain(TEXTURE_CLAMP, ivec2(4)), vec2(x[i])).x, clamped[i], 1e-6);
    }
    // Each axis has its own.
    TextureRef t = plain(TEXTURE_REPEAT, ivec2(4));
    t.wrap.y = TEXTURE_MIRROR;
    EXPECT_NEAR(wrap_coordinate(t, vec2(1.25)).x, 0.25, 1e-6);
    EXPECT_NEAR(wrap_coordinate(t, vec2(1.25)).y, 0.75, 1e-6);
}

void test_wrap_texel()
{
    const ivec2 size = ivec2(5, 1);
    EXPECT_EQ(wrap_texel(plain(TEXTURE_REPEAT, size), ivec2(-1, -1), size).x, 4);
    EXPECT_EQ(wrap_texel(plain(TEXTURE_REPEAT, size), ivec2(-1, -1), size).y, 0);
    EXPECT_EQ(wrap_texel(plain(TEXTURE_REPEAT, size), ivec2(5, 1), size).x, 0);
    EXPECT_EQ(wrap_texel(plain(TEXTURE_MIRROR, size), ivec2(-1, 0), size).x, 0);
    EXPECT_EQ(wrap_texel(plain(TEXTURE_MIRROR, size), ivec2(5, 1), size).x, 4);
    EXPECT_EQ(wrap_texel(plain(TEXTURE_CLAMP, size), ivec2(-1, 0), size).x, 0);
    // Whatever a NaN becomes as an integer, it stays inside.
    EXPECT_EQ(wrap_texel(plain(TEXTURE_REPEAT, size), ivec2(-2147483647), size).x, 0);
    EXPECT_EQ(wrap_texel(plain(TEXTURE_REPEAT, size), ivec2(2147483647), size).x, 4);
}

void test_level()
{
    const TextureRef t = plain(TEXTURE_REPEAT, ivec2(64, 16));
    // 32 texels side by side, on average, under the unit square: a footprint of 1/32 is a texel.
    EXPECT_NEAR(lookup(t, vec2(0.0), -5.0).lod, 0.0, 1e-5);
    EXPECT_NEAR(lookup(t, vec2(0.0), -3.5).lod, 1.5, 1e-5);
    EXPECT_EQ(lookup(t, vec2(0.0), -30.0).lod, 0.0);
    EXPECT_EQ(lookup(t, vec2(0.0), 30.0).lod, 6.0);
    EXPECT_EQ(lookup(t, vec2(0.0), uintBitsToFloat(0x7fc00000u)).lod, 0.0);
    // An image repeated twice as often along both axes has texels of half the size.
    TextureRef finer = t;
    finer.column_u *= 2.0;
    finer.column_v *= 2.0;
    EXPECT_NEAR(lookup(finer, vec2(0.0), -5.0).lod, 1.0, 1e-5);
    // A cone 1 cm wide on a metre of 4 repeats, seen at 60 degrees from the normal.
    const vec3 along = vec3(sqrt(0.75), 0.0, -0.5);
    EXPECT_NEAR(log2_cone_width(0.01, vec3(0.0, 0.0, 1.0), along) + 2.0, log2(4.0 * 0.02), 1e-5);
}

// The largest number below 1 must not lead beyond the single texel of the last level.
void test_random_level()
{
    const TextureRef t = plain(TEXTURE_REPEAT, ivec2(64, 16));
    const float largest = uintBitsToFloat(0x3f7fffffu);
    EXPECT_EQ(random_level(t, 6.0, largest), 6);
    EXPECT_EQ(random_level(t, 5.5, largest), 6);
    EXPECT_EQ(random_level(t, 5.5, 0.25), 5);
    EXPECT_EQ(random_level(plain(TEXTURE_REPEAT, ivec2(1)), 0.0, largest), 0);
}

void test_transform()
{
    TextureRef t = plain(TEXTURE_CLAMP, ivec2(4));
    t.column_u = vec2(0.0, 0.5);
    t.column_v = vec2(-0.25, 0.0);
    t.offset = vec2(0.75, 0.125);
    const vec2 at = lookup(t, vec2(0.5, 1.0), 0.0).at;
    EXPECT_NEAR(at.x, 0.5, 1e-6);
    EXPECT_NEAR(at.y, 0.375, 1e-6);
}

// What C++ packs of no texture reads as white.
void test_no_texture()
{
    const TextureRef none = unpack_texture(uvec4(0u), uvec4(0u));
    EXPECT_TRUE(texture_filtered(none, vec2(0.3), 0.0) == vec4(1.0));
    EXPECT_TRUE(texture_stochastic(none, vec2(0.3), 0.0, vec3(0.5)) == vec4(1.0));
}

void main()
{
    test_wrap_coordinate();
    test_wrap_texel();
    test_level();
    test_random_level();
    test_transform();
    test_no_texture();
}
