// TextureArrays: a scene's images with their mip levels on the device.
#pragma once

#include "server/scene/textures.h"

#include <epoxy/gl.h>
#include <string>

namespace farlight {

class TextureArrays {
public:
    /// Arrays of no layout hold one black texel, so that programs may bind all TEXTURE_ARRAYS.
    /// Throws GlError if the device has no room.
    explicit TextureArrays(const TextureLayout& layout);
    ~TextureArrays();
    TextureArrays(const TextureArrays&) = delete;
    TextureArrays& operator=(const TextureArrays&) = delete;

    /// texture_array_0, texture_array_1, ...: as shaders call them.
    const std::map<std::string, GLuint, std::less<>>& textures() const { return textures_; }
    struct Array {
        std::string name;
        std::string content;  ///< "3 layers of 8x8 sRGB texels with mip levels".
        std::size_t bytes = 0;
    };
    /// Those that hold images.
    const std::vector<Array>& arrays() const { return arrays_; }

private:
    std::map<std::string, GLuint, std::less<>> textures_;
    std::vector<Array> arrays_;
};

}  // namespace farlight
