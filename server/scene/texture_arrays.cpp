// Immutable storage a layout array, filled layer by layer and level by level.
#include "server/scene/texture_arrays.h"

#include "server/gl/gl_error.h"
#include "server/gl/texture.h"

namespace farlight {
namespace {

GLuint storage(const std::string& label, const TextureArrayLayout& array)
{
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    glTextureStorage3D(id, static_cast<GLsizei>(array.levels()),
        array.space == TexelSpace::kSrgb ? GL_SRGB8_ALPHA8 : GL_RGBA8,
        static_cast<GLsizei>(array.width), static_cast<GLsizei>(array.height),
        static_cast<GLsizei>(array.images.size()));
    set_sampler_of_texels(id);
    glObjectLabel(GL_TEXTURE, id, -1, label.c_str());
    return id;
}

void fill_layer(GLuint id, GLint layer, const std::vector<Image8>& levels)
{
    for (std::size_t level = 0; level < levels.size(); ++level) {
        const Image8& image = levels[level];
        glTextureSubImage3D(id, static_cast<GLint>(level), 0, 0, layer,
            static_cast<GLsizei>(image.width), static_cast<GLsizei>(image.height), 1, GL_RGBA,
            GL_UNSIGNED_BYTE, image.texels.data());
    }
}

std::string content_of(const TextureArrayLayout& array)
{
    return std::to_string(array.images.size()) + " layers of " + std::to_string(array.width) + "x"
        + std::to_string(array.height) + (array.space == TexelSpace::kSrgb ? " sRGB" : " linear")
        + " texels with mip levels";
}

}  // namespace

TextureArrays::TextureArrays(const TextureLayout& layout)
{
    const TextureArrayLayout nothing{TexelSpace::kLinear, 1, 1, {kNone}};
    const std::vector<Image8> black{Image8{{}, 1, 1, {glm::u8vec4(0)}}};
    for (std::size_t i = 0; i < TEXTURE_ARRAYS; ++i) {
        const bool used = i < layout.arrays().size();
        const TextureArrayLayout& array = used ? layout.arrays()[i] : nothing;
        const std::string name = "texture_array_" + std::to_string(i);
        const GLuint id = storage(name, array);
        textures_[name] = id;
        check_gl("allocating " + name + ", " + content_of(array));
        for (std::size_t layer = 0; layer < array.images.size(); ++layer)
            fill_layer(id, static_cast<GLint>(layer),
                used ? mip_levels(layout.images()[array.images[layer]], array.space) : black);
        check_gl("uploading " + name);
        if (used)
            arrays_.push_back({name, content_of(array), array.bytes()});
    }
}

TextureArrays::~TextureArrays()
{
    for (const auto& [name, id] : textures_)
        glDeleteTextures(1, &id);
}

}  // namespace farlight
