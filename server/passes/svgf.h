// SVGF stage: temporal accumulation, variance estimation, a-trous wavelet filter (Schied et al.
// 2017), for each kind of signal by itself, so that none is changed by another's being there.
#pragma once

#include "server/host_guard.h"
#include "server/passes/path_trace.h"

#include <algorithm>

namespace farlight {

inline const HostGuard light_histories_in_32_bits("light_histories_in_32_bits");

/// Of light over time. In 16 bits an exponential average stops short of what it follows, by 3 %
/// where a frame weighs 1/64, and the word of its noise has no place.
inline GLenum light_history_format()
{
    return light_histories_in_32_bits ? GL_RGBA32F : GL_RGBA16F;
}

/// What the filter leaves behind, for the composite and for people who look inside.
struct SvgfOutput {
    Signals filtered;
    Signals blended;  ///< Before the wavelet filter; alpha holds the variance estimate.
    TextureHandle history_length;  ///< Of diffuse light.
};

/// Textures of one or two signals of a kind.
using SignalTextures = std::vector<TextureHandle>;

/// Signals that share their histories and their weights.
struct SignalKind {
    const char* macro;  ///< What the filter's shaders are compiled with.
    std::string prefix;  ///< Of pass names; empty for diffuse light.
    std::vector<std::string> names;
    GLenum moments_format;
};

inline const SignalKind& diffuse_kind()
{
    static const SignalKind kind{"SIGNAL_DIFFUSE", "", {"direct", "indirect"}, GL_RGBA32F};
    return kind;
}
inline const SignalKind& specular_kind()
{
    static const SignalKind kind{"SIGNAL_SPECULAR", "specular ", {"specular"}, GL_RG32F};
    return kind;
}
inline const SignalKind& scattered_kind()
{
    static const SignalKind kind{"SIGNAL_SCATTERED", "scattered ", {"scattered"}, GL_RG32F};
    return kind;
}

/// One kind's way through the filter.
class SvgfSignal {
public:
    SvgfSignal(FrameGraph& graph, const FrameInputs& inputs, const GBuffer& gbuffer,
        const RenderSettings& settings, const SignalKind& kind)
        : graph_(graph)
        , inputs_(inputs)
        , gbuffer_(gbuffer)
        , settings_(settings)
        , kind_(kind)
        , moments_(graph.history(history_name("moments"), kind.moments_format))
        , length_(graph.history(history_name("length"), GL_R32F))
    {
        for (const std::string& name : kind.names)
            past_.push_back(graph.history("svgf.history_" + name, light_history_format()));
    }

    /// After this, blended(), filtered() and length() are there.
    /// `shown`: of the specular signal.
    void filter(const SignalTextures& noisy, TextureHandle shown = {})
    {
        shown_ = shown;
        SignalTextures feedback;
        for (const History& past : past_)
            feedback.push_back(past.current);
        // The output of this iteration becomes history; 0: the unfiltered blend does.
        const int feedback_iteration =
            std::min(settings_.svgf_feedback_iteration, settings_.atrous_iterations);
        const SignalTextures mixed = feedback_iteration == 0 ? feedback : fresh();
        add_temporal(noisy, mixed);
        blended_ = fresh();
        add_variance(mixed, blended_);
        filtered_ = blended_;
        for (int i = 1; i <= settings_.atrous_iterations; ++i) {
            const SignalTextures next = i == feedback_iteration ? feedback : fresh();
            add_atrous(filtered_, next, i);
            filtered_ = next;
        }
    }

    const SignalTextures& blended() const { return blended_; }
    const SignalTextures& filtered() const { return filtered_; }
    TextureHandle length() const { return length_.current; }

private:
    std::string history_name(const char* what) const
    {
        return std::string("svgf.") + (kind_.names.size() == 1 ? kind_.names[0] + "_" : "") + what;
    }

    SignalTextures fresh()
    {
        SignalTextures textures;
        for (const std::string& name : kind_.names)
            textures.push_back(graph_.create("svgf." + name, GL_RGBA32F));
        return textures;
    }

    Pass& add_pass(const std::string& name, const char* shader, const SignalTextures& in,
        const SignalTextures& out)
    {
        static constexpr const char* kIn[] = {"in_light", "in_light_2"};
        static constexpr const char* kOut[] = {"out_light", "out_light_2"};
        Pass& pass =
            graph_.add_pass("svgf " + kind_.prefix + name, shader).define({{kind_.macro, "1"}});
        for (std::size_t i = 0; i < in.size(); ++i)
            pass.read(kIn[i], in[i]).write(kOut[i], out[i]);
        if (is(scattered_kind())) {
            pass.read("in_fog_way", gbuffer_.fog_way).constant("fog_sigma_t", inputs_.fog.sigma_t);
        } else {
            pass.read("in_surface", gbuffer_.surface);
            if (inputs_.has_lens())
                inputs_.add_lens_constants(pass.define({{"FX_LENS", "1"}}));
        }
        if (is(specular_kind()))
            pass.read("in_reflectance", gbuffer_.reflectance);
        if (settings_.error_estimate)
            pass.define({{"ERROR_ESTIMATE", "1"}});
        return pass;
    }

    void add_temporal(const SignalTextures& noisy, const SignalTextures& mixed)
    {
        static constexpr const char* kPrevious[] = {"prev_light", "prev_light_2"};
        bool valid = moments_.valid && length_.valid
            && (is(scattered_kind()) ? gbuffer_.fog_history_valid : gbuffer_.surface_history_valid);
        for (const History& past : past_)
            valid = valid && past.valid;
        Pass& pass = add_pass("temporal", "svgf/temporal.comp", noisy, mixed)
                         .read("prev_moments", moments_.previous)
                         .read("prev_length", length_.previous)
                         .write("out_moments", moments_.current)
                         .write("out_length", length_.current)
                         .constant("history_valid", valid ? 1 : 0)
                         .constant("history_max", settings_.history_max)
                         .constant("svgf_alpha", settings_.svgf_alpha)
                         .constant("svgf_moments_alpha", settings_.svgf_moments_alpha);
        for (std::size_t i = 0; i < past_.size(); ++i)
            pass.read(kPrevious[i], past_[i].previous);
        if (is(specular_kind()))
            pass.read("in_position", gbuffer_.position);
        if (is(scattered_kind()))
            pass.read("prev_fog_way", gbuffer_.prev_fog_way);
        else
            pass.read("in_identity", gbuffer_.identity)
                .read("in_motion", gbuffer_.motion)
                .read("prev_surface", gbuffer_.prev_surface)
                .read("prev_identity", gbuffer_.prev_identity)
                .constant("reproject_depth", settings_.reproject_depth)
                .constant("reproject_normal", settings_.reproject_normal);
    }

    void add_variance(const SignalTextures& mixed, const SignalTextures& estimated)
    {
        Pass& pass = add_pass("variance", "svgf/variance.comp", mixed, estimated)
                         .read("in_moments", moments_.current)
                         .read("in_length", length_.current)
                         .constant("svgf_spatial_frames", settings_.svgf_spatial_frames);
        add_edges(pass);
    }

    /// `iteration` 1, 2, 3, ... filters with taps 1, 2, 4, ... pixels apart.
    void add_atrous(const SignalTextures& in, const SignalTextures& out, int iteration)
    {
        Pass& pass = add_pass("a-trous " + std::to_string(iteration), "svgf/atrous.comp", in, out)
                         .constant("step_size", 1 << (iteration - 1))
                         .constant("sigma_luminance", settings_.sigma_luminance);
        add_edges(pass);
    }

    /// What the weights between two pixels look at, beyond what every pass does.
    void add_edges(Pass& pass) const
    {
        if (is(specular_kind()))
            pass.read("in_shown", shown_);
        if (!is(scattered_kind()))
            pass.constant("sigma_depth", settings_.sigma_depth)
                .constant("sigma_normal", settings_.sigma_normal);
    }

    bool is(const SignalKind& kind) const { return &kind_ == &kind; }

    FrameGraph& graph_;
    const FrameInputs& inputs_;
    const GBuffer& gbuffer_;
    const RenderSettings& settings_;
    const SignalKind& kind_;
    std::vector<History> past_;
    History moments_;
    History length_;
    TextureHandle shown_;
    SignalTextures blended_;
    SignalTextures filtered_;
};

inline SvgfOutput add_svgf(FrameGraph& graph, const FrameInputs& inputs, const GBuffer& gbuffer,
    const Signals& noisy, const RenderSettings& settings)
{
    SvgfOutput output;
    SvgfSignal diffuse(graph, inputs, gbuffer, settings, diffuse_kind());
    diffuse.filter({noisy.direct, noisy.indirect});
    output.blended.direct = diffuse.blended()[0];
    output.blended.indirect = diffuse.blended()[1];
    output.filtered.direct = diffuse.filtered()[0];
    output.filtered.indirect = diffuse.filtered()[1];
    output.history_length = diffuse.length();
    if (inputs.has_specular()) {
        SvgfSignal specular(graph, inputs, gbuffer, settings, specular_kind());
        specular.filter({noisy.specular}, noisy.shown);
        output.blended.specular = specular.blended()[0];
        output.filtered.specular = specular.filtered()[0];
    }
    if (inputs.has_fog()) {
        SvgfSignal scattered(graph, inputs, gbuffer, settings, scattered_kind());
        scattered.filter({noisy.scattered});
        output.blended.scattered = scattered.blended()[0];
        output.filtered.scattered = scattered.filtered()[0];
    }
    return output;
}

}  // namespace farlight
