// Texture lifetimes, barriers, dispatch.
#include "server/render/frame_graph.h"

#include "server/gl/gl_error.h"
#include "server/host_guard.h"

#include <algorithm>
#include <cassert>

namespace farlight {
namespace {

const HostGuard last_work_group("last_work_group");

std::size_t bytes_per_texel(GLenum format)
{
    switch (format) {
    case GL_RGBA32F:
    case GL_RGBA32UI: return 16;
    case GL_RG32F:
    case GL_RGBA16F: return 8;
    default: return 4;
    }
}

}  // namespace

FrameGraph::FrameGraph(ProgramCache& programs, bool software, bool strict)
    : programs_(programs)
    , check_(strict)
    , timer_(software)
{
}

void FrameGraph::begin_frame(Extent extent, std::vector<BlockInput> blocks)
{
    for (Resource& resource : resources_)
        if (resource.kept && resource.transient && resource.texture != nullptr)
            pool_.push_back({std::move(resource.texture)});
    if (extent != extent_) {  // after the last frame's have come back, or they would be used again
        pool_.clear();
        extent_ = extent;
    }
    for (auto& [name, pair] : histories_) {
        pair.written_last_frame = pair.resource_current >= 0
            && resources_[static_cast<std::size_t>(pair.resource_current)].written;
        if (pair.written_last_frame)
            pair.current = 1 - pair.current;
        pair.idle_frames = pair.resource_previous < 0 ? pair.idle_frames + 1 : 0;
        pair.resource_previous = pair.resource_current = -1;
    }
    drop_idle();
    resources_.clear();
    passes_.clear();
    blocks_ = std::move(blocks);
    defines_for_all_.clear();
    timer_.begin_frame();
}

void FrameGraph::drop_idle()
{
    std::erase_if(
        histories_, [](const auto& entry) { return entry.second.idle_frames >= kIdleFrames; });
    std::erase_if(pool_, [](Spare& spare) { return spare.idle_frames++ >= kIdleFrames; });
}

TextureHandle FrameGraph::create(const std::string& name, GLenum format)
{
    resources_.push_back({.name = name, .format = format, .kept = keeps_all_});
    return {static_cast<int>(resources_.size()) - 1};
}

History FrameGraph::history(const std::string& name, GLenum format)
{
    HistoryPair& pair = histories_[name];
    if (pair.format != format) {
        pair = {.format = format};
    }
    if (pair.resource_current < 0) {
        for (int age = 1; age >= 0; --age)
            resources_.push_back({.name = name, .format = format, .transient = false});
        pair.resource_previous = static_cast<int>(resources_.size()) - 2;
        pair.resource_current = static_cast<int>(resources_.size()) - 1;
    }
    return {{pair.resource_previous}, {pair.resource_current}, pair.written_last_frame};
}

void FrameGraph::forget_histories()
{
    for (auto& [name, pair] : histories_)
        pair.resource_current = -1;
}

Pass& FrameGraph::add_pass(const std::string& name, const std::string& shader)
{
    passes_.push_back({name, shader});
    passes_.back().domain = extent_;
    passes_.back().define(defines_for_all_);
    return passes_.back();
}

void FrameGraph::keep(TextureHandle texture)
{
    resources_[static_cast<std::size_t>(texture.index)].kept = true;
}

void FrameGraph::find_lifetimes()
{
    for (std::size_t i = 0; i < passes_.size(); ++i)
        for (const Pass::Use& use : passes_[i].uses)
            resources_[static_cast<std::size_t>(use.texture.index)].last_pass = static_cast<int>(i);
}

void FrameGraph::allocate_histories()
{
    for (auto& [name, pair] : histories_) {
        if (pair.resource_current < 0)
            continue;
        for (int age = 0; age < 2; ++age) {
            std::shared_ptr<GpuTexture>& texture = pair.textures[age];
            const bool fits = texture != nullptr
                && (texture->extent() == extent_
                    || (age != pair.current && pair.written_last_frame));
            if (!fits)
                texture = std::make_shared<GpuTexture>(name, pair.format, extent_);
        }
        resources_[static_cast<std::size_t>(pair.resource_current)].texture =
            pair.textures[pair.current];
        resources_[static_cast<std::size_t>(pair.resource_previous)].texture =
            pair.textures[1 - pair.current];
    }
}

void FrameGraph::execute()
{
    find_lifetimes();
    allocate_histories();
    barriers_ = 0;
    for (std::size_t i = 0; i < passes_.size(); ++i)
        run(passes_[i], static_cast<int>(i));
    timer_.end_frame();
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT
        | GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT
        | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    dirty_.clear();
    read_.clear();
    check_gl("frame");
}

void FrameGraph::run(const Pass& pass, int pass_index)
{
    const Program& program = programs_.get(pass.shader, pass.defines);
    check_(pass, program, blocks_);
    for (const Pass::Use& use : pass.uses) {
        Resource& resource = resources_[static_cast<std::size_t>(use.texture.index)];
        if (use.write)
            acquire(resource);
        else if (resource.texture == nullptr)
            throw ShaderError("pass '" + pass.name + "': '" + use.name + "' reads texture '"
                + resource.name + "' before any pass has written it");
    }
    place_barrier(pass);

    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, pass.name.c_str());
    timer_.begin(pass.name);
    glUseProgram(program.id());
    bind_textures(pass, program);
    set_constants(pass, program);
    const GLint* group = program.work_group_size();
    const auto groups = [](int pixels, GLint size) {
        return static_cast<GLuint>((last_work_group ? pixels + size - 1 : pixels) / size);
    };
    glDispatchCompute(groups(pass.domain.width, group[0]), groups(pass.domain.height, group[1]), 1);
    timer_.end();
    glPopDebugGroup();

    for (const Pass::Use& use : pass.uses) {
        Resource& resource = resources_[static_cast<std::size_t>(use.texture.index)];
        if (use.write) {
            resource.written = true;
            dirty_.push_back(resource.texture->id());
        } else {
            read_.push_back(resource.texture->id());
        }
    }
    for (const Pass::Use& use : pass.uses) {  // a pass may read one texture by two names
        Resource& resource = resources_[static_cast<std::size_t>(use.texture.index)];
        if (resource.transient && !resource.kept && resource.last_pass == pass_index
            && resource.texture != nullptr)
            pool_.push_back({std::move(resource.texture)});
    }
}

void FrameGraph::acquire(Resource& resource)
{
    if (resource.texture != nullptr)
        return;
    const auto found = std::find_if(pool_.begin(), pool_.end(),
        [&](const Spare& spare) { return spare.texture->format() == resource.format; });
    if (found != pool_.end()) {
        resource.texture = std::move(found->texture);
        pool_.erase(found);
        resource.texture->relabel(resource.name);
    } else {
        resource.texture = std::make_shared<GpuTexture>(resource.name, resource.format, extent_);
    }
}

void FrameGraph::place_barrier(const Pass& pass)
{
    const auto holds = [](const std::vector<GLuint>& textures, GLuint id) {
        return std::find(textures.begin(), textures.end(), id) != textures.end();
    };
    const bool hazard = std::any_of(pass.uses.begin(), pass.uses.end(), [&](const Pass::Use& use) {
        const GLuint id = resources_[static_cast<std::size_t>(use.texture.index)].texture->id();
        return holds(dirty_, id) || (use.write && holds(read_, id));
    });
    if (!hazard && !pass.waits)
        return;
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT
        | GL_SHADER_STORAGE_BARRIER_BIT);
    dirty_.clear();
    read_.clear();
    ++barriers_;
}

void FrameGraph::bind_textures(const Pass& pass, const Program& program)
{
    for (const Pass::Use& use : pass.uses) {
        const auto variable = program.uniforms().find(use.name);
        if (variable == program.uniforms().end())
            continue;
        const GpuTexture& texture =
            *resources_[static_cast<std::size_t>(use.texture.index)].texture;
        const auto unit = static_cast<GLuint>(variable->second.unit);
        if (kind_of(variable->second.type) == VariableKind::kImage)
            glBindImageTexture(unit, texture.id(), 0, GL_FALSE, 0,
                use.write ? GL_WRITE_ONLY : GL_READ_ONLY, texture.format());
        else
            glBindTextureUnit(unit, texture.id());
    }
    if (pass.scene_inputs != nullptr)
        for (const auto& [name, texture] : pass.scene_inputs->buffers)
            if (const auto found = program.uniforms().find(name); found != program.uniforms().end())
                glBindTextureUnit(static_cast<GLuint>(found->second.unit), texture);
    for (const BlockInput& block : blocks_) {
        if (const auto found = program.uniform_blocks().find(block.name);
            found != program.uniform_blocks().end())
            glBindBufferBase(GL_UNIFORM_BUFFER, found->second, block.buffer);
        if (const auto found = program.storage_blocks().find(block.name);
            found != program.storage_blocks().end())
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, found->second, block.buffer);
    }
}

void FrameGraph::set_constants(const Pass& pass, const Program& program) const
{
    for (const auto& [name, value] : pass.constants) {
        const auto variable = program.uniforms().find(name);
        if (variable == program.uniforms().end())
            continue;
        const GLint at = variable->second.location;
        const GLuint id = program.id();
        if (const auto* v = std::get_if<int>(&value))
            glProgramUniform1i(id, at, *v);
        else if (const auto* u = std::get_if<unsigned>(&value))
            glProgramUniform1ui(id, at, *u);
        else if (const auto* f = std::get_if<float>(&value))
            glProgramUniform1f(id, at, *f);
        else if (const auto* v2 = std::get_if<glm::vec2>(&value))
            glProgramUniform2f(id, at, v2->x, v2->y);
        else if (const auto* v3 = std::get_if<glm::vec3>(&value))
            glProgramUniform3f(id, at, v3->x, v3->y, v3->z);
    }
}

const GpuTexture& FrameGraph::texture(TextureHandle handle) const
{
    const Resource& resource = resources_[static_cast<std::size_t>(handle.index)];
    assert(resource.texture != nullptr && "not kept");
    return *resource.texture;
}

std::vector<std::pair<std::string, const GpuTexture*>> FrameGraph::written() const
{
    std::vector<std::pair<std::string, const GpuTexture*>> textures;
    for (const Resource& resource : resources_)
        if (resource.written && resource.texture != nullptr)
            textures.emplace_back(resource.name, resource.texture.get());
    return textures;
}

std::vector<TextureAllocation> FrameGraph::allocations() const
{
    std::vector<TextureAllocation> held;
    const auto add = [&](const std::string& name, const std::shared_ptr<GpuTexture>& texture) {
        if (texture != nullptr)
            held.push_back({name,
                bytes_per_texel(texture->format())
                    * static_cast<std::size_t>(texture->extent().width)
                    * static_cast<std::size_t>(texture->extent().height)});
    };
    for (const Spare& spare : pool_)
        add("scratch", spare.texture);
    for (const Resource& resource : resources_)
        if (resource.transient)
            add(resource.name, resource.texture);
    for (const auto& [name, pair] : histories_)
        for (const auto& texture : pair.textures)
            add(name, texture);
    return held;
}

std::size_t FrameGraph::texture_bytes() const
{
    std::size_t bytes = 0;
    for (const TextureAllocation& allocation : allocations())
        bytes += allocation.bytes;
    return bytes;
}

std::vector<ProgramKey> FrameGraph::programs() const
{
    std::vector<ProgramKey> keys;
    for (const Pass& pass : passes_)
        keys.push_back({pass.shader, pass.defines});
    return keys;
}

std::vector<std::string> FrameGraph::pass_names() const
{
    std::vector<std::string> names;
    for (const Pass& pass : passes_)
        names.push_back(pass.name);
    return names;
}

}  // namespace farlight
