// FrameGraph: the passes of one frame, declared by the names their shaders use.
//
// A frame is declared anew each time (cheap: programs and textures are kept), then execute() checks
// every declaration against its program, puts barriers between writers and readers, dispatches and
// times each pass.
//   transient texture   lives within the frame; its memory is reused after its last reader
//   history texture     `current` of this frame is `previous` of the next; owned by the graph
#pragma once

#include "server/gl/extent.h"
#include "server/gl/gpu_timer.h"
#include "server/gl/program_cache.h"
#include "server/gl/texture.h"
#include "server/render/declaration_check.h"
#include "server/render/pass.h"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace farlight {

struct History {
    TextureHandle previous;  ///< Last frame's `current`, at that frame's size; anything when not
                             ///< `valid`.
    TextureHandle current;  ///< To be written this frame.
    bool valid = false;  ///< Last frame wrote it.
};

/// A texture that a graph holds.
struct TextureAllocation {
    std::string name;
    std::size_t bytes = 0;
};

class FrameGraph {
public:
    /// Enough for callers that draw in turns with and without something.
    static constexpr int kIdleFrames = 8;

    /// `software`: passes are timed by the host clock.
    /// `strict`: see DeclarationCheck.
    FrameGraph(ProgramCache& programs, bool software, bool strict);

    /// Starts declaring a frame. With another extent than the last one, histories stay as they are:
    /// who reads them knows their size, or calls forget_histories(). What kIdleFrames frames had no
    /// use for is dropped.
    void begin_frame(Extent extent, std::vector<BlockInput> blocks);
    Extent extent() const { return extent_; }

    TextureHandle create(const std::string& name, GLenum format);
    /// The same name gives the same pair all frame long.
    History history(const std::string& name, GLenum format);
    /// No history is valid in the frame declared next: call it before begin_frame().
    void forget_histories();
    /// Every pass added to this frame from now on is compiled with these too.
    void define_for_all(Defines defines) { defines_for_all_ = std::move(defines); }
    /// The reference is valid until the next add_pass().
    Pass& add_pass(const std::string& name, const std::string& shader);
    /// Every transient keeps its texture and content until the next begin_frame(): for those who
    /// look inside.
    void keep_all() { keeps_all_ = true; }
    /// Keeps a transient's content until the next begin_frame(), for readback.
    void keep(TextureHandle texture);

    /// Runs the frame. Throws ShaderError naming pass and variable when declaration and shader
    /// disagree.
    void execute();

    /// The texture behind a handle, after execute(), if it was kept or is a history.
    const GpuTexture& texture(TextureHandle handle) const;
    std::vector<TimedPass> collect_times() { return timer_.collect(); }
    /// What lies between the passes included [ms].
    double frame_time() { return timer_.whole_frame(); }
    /// What the passes of the last executed frame wrote, in the order of declaration, if it was
    /// kept.
    std::vector<std::pair<std::string, const GpuTexture*>> written() const;
    /// Bytes of all textures held, and how many.
    std::size_t texture_bytes() const;
    std::vector<std::string> pass_names() const;
    /// The programs that the frame being declared will ask for.
    std::vector<ProgramKey> programs() const;
    /// What is held: the frame's transients, histories, and what waits to be used again.
    std::vector<TextureAllocation> allocations() const;
    /// Barriers between passes of the last executed frame.
    int barrier_count() const { return barriers_; }

private:
    struct Resource {
        std::string name;
        GLenum format = 0;
        std::shared_ptr<GpuTexture> texture;  ///< Transients get theirs when first written.
        int last_pass = -1;
        bool transient = true;
        bool written = false;
        bool kept = false;
    };
    struct HistoryPair {
        GLenum format = 0;
        std::array<std::shared_ptr<GpuTexture>, 2> textures;
        int current = 0;
        int idle_frames = 0;
        bool written_last_frame = false;
        int resource_previous = -1;
        int resource_current = -1;
    };

    /// A texture that the next transient of its format may take.
    struct Spare {
        std::shared_ptr<GpuTexture> texture;
        int idle_frames = 0;
    };

    void drop_idle();
    void find_lifetimes();
    void allocate_histories();
    void run(const Pass& pass, int pass_index);
    void acquire(Resource& resource);
    void bind_textures(const Pass& pass, const Program& program);
    void set_constants(const Pass& pass, const Program& program) const;
    void place_barrier(const Pass& pass);

    ProgramCache& programs_;
    DeclarationCheck check_;
    bool keeps_all_ = false;
    GpuTimer timer_;
    Extent extent_;
    std::vector<BlockInput> blocks_;
    Defines defines_for_all_;
    std::vector<Resource> resources_;
    std::vector<Pass> passes_;
    std::map<std::string, HistoryPair> histories_;
    std::vector<Spare> pool_;
    std::vector<GLuint> dirty_;  ///< Textures written since the last barrier.
    std::vector<GLuint> read_;  ///< Textures read since: a write to one must wait too.
    int barriers_ = 0;
};

}  // namespace farlight
