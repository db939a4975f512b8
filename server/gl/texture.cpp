// 2D storage, cleared at birth so that no frame shows another's pixels.
#include "server/gl/texture.h"

#include "server/gl/gl_error.h"

namespace farlight {

void set_sampler_of_texels(GLuint texture)
{
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

GpuTexture::GpuTexture(const std::string& label, GLenum format, Extent extent)
    : format_(format)
    , extent_(extent)
{
    glCreateTextures(GL_TEXTURE_2D, 1, &id_);
    glTextureStorage2D(id_, 1, format, extent.width, extent.height);
    set_sampler_of_texels(id_);
    relabel(label);
    check_gl("allocating texture '" + label + "' of " + std::to_string(extent.width) + "x"
        + std::to_string(extent.height));
    const bool integer = format == GL_RGBA32UI || format == GL_RG32UI || format == GL_R32UI;
    glClearTexImage(
        id_, 0, integer ? GL_RGBA_INTEGER : GL_RGBA, integer ? GL_UNSIGNED_INT : GL_FLOAT, nullptr);
    check_gl("clearing texture '" + label + "'");
}

GpuTexture::~GpuTexture()
{
    glDeleteTextures(1, &id_);
}

void GpuTexture::relabel(const std::string& label)
{
    glObjectLabel(GL_TEXTURE, id_, -1, label.c_str());
}

}  // namespace farlight
