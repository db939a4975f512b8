// A server and what clients ask of it in mid-stream: other sizes, other times, other scenes.
#include "lab/groups.h"
#include "lab/server_bench.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace farlight::lab {
namespace {

using client::Frame;
using client::Session;
using nlohmann::json;
using protocol::Size;
using Settings = std::map<std::string, json>;

/// Every wall emits 1 and reflects half: a path of at most four segments by chance sees
/// 1 + 1/2 + 1/4 + 1/8.
constexpr double kFurnace = 1.875;

json furnace()
{
    return {{"version", 1},
        {"materials",
            {{"wall",
                {{"albedo", {0.5, 0.5, 0.5}}, {"emission", {1, 1, 1}},
                    {"emits_both_sides", true}}}}},
        {"objects",
            {{{"material", "wall"}, {"box", {{"center", {0, 0, 0}}, {"size", {2, 2, 2}}}}}}},
        {"camera",
            {{"position", {0.1, 0.2, 0.6}}, {"target", {0, 0, -1}}, {"vertical_fov_degrees", 60}}}};
}

/// A lit floor and wall, and a ball that circles once in three seconds.
json circling_ball()
{
    return {{"version", 1}, {"materials", {{"white", {{"albedo", {0.8, 0.8, 0.8}}}}}},
        {"background", {0.5, 0.6, 0.7}},
        {"objects",
            {{{"name", "floor"}, {"material", "white"},
                 {"quad", {{"corner", {-4, 0, 4}}, {"edge_u", {8, 0, 0}}, {"edge_v", {0, 0, -8}}}}},
                {{"name", "wall"}, {"material", "white"},
                    {"quad",
                        {{"corner", {-4, 0, -2}}, {"edge_u", {8, 0, 0}}, {"edge_v", {0, 4, 0}}}}},
                {{"name", "ball"}, {"material", "white"},
                    {"sphere", {{"center", {1.2, 0.5, 0}}, {"radius", 0.4}}},
                    {"spin", {{"axis", {0, 1, 0}}, {"center", {0, 0.5, 0}}, {"period", 3}}}}}},
        {"camera",
            {{"position", {0, 1.5, 5}}, {"target", {0, 0.8, 0}}, {"vertical_fov_degrees", 45}}}};
}

/// Values of a frame that are not as its header says, and its picture.
struct Received {
    client::Picture picture;
    double bad =
        0;  ///< 1 where size or payload are not those asked for, and stages that met bad values.
};

Received receive(const Frame& frame, const Size& asked)
{
    Received received{client::decode_picture(frame.header, frame.payload)};
    const std::size_t values = std::size_t{3} * asked[0] * asked[1];
    const bool as_asked = frame.header.width == asked[0] && frame.header.height == asked[1]
        && frame.header.full_width == asked[0] && frame.header.full_height == asked[1]
        && frame.payload.size() == 4 * values && received.picture.linear.size() == values;
    received.bad = (as_asked ? 0 : 1) + static_cast<double>(frame.header.stages.size());
    return received;
}

bool is_refused(Session& session, const Size& size)
{
    try {
        session.resize(size);
        return false;
    } catch (const client::RefusedError&) {
        return true;
    }
}

/// One row, one column, odd sides, sides that no work group divides, more than 8192.
void any_size(Findings& findings, Length /*length*/)
{
    ServerBench bench(furnace());
    double bad = 0;
    double off = 0;
    const auto most = static_cast<std::uint32_t>(std::min(bench.max_dimension(), 8193));
    for (const Size size : {Size{1, 1}, Size{1, 37}, Size{53, 1}, Size{2, 2}, Size{7, 5},
             Size{17, 33}, Size{65, 63}, Size{most, 1}, Size{1, most}}) {
        Session session = bench.session(size, {{"light_sampling", false}, {"roulette_depth", 64}});
        for (int i = 0; i < 2; ++i) {
            const Received received = receive(session.draw(session.welcome().camera), size);
            bad += received.bad;
            for (const float value : received.picture.linear)
                off = farther(off, std::abs(value / kFurnace - 1));
        }
    }
    double taken = 0;
    Session session = bench.session({3, 2});
    for (const Size size : {Size{static_cast<std::uint32_t>(bench.max_dimension()) + 1, 1},
             Size{0, 5}, Size{65535, 65535}})
        taken += is_refused(session, size) ? 0 : 1;
    bad += receive(session.draw(session.welcome().camera), {3, 2}).bad;
    findings.at_most("deviation of any pixel from a constant picture, 1x1 to "
            + std::to_string(most) + " a side",
        off, 1e-5);
    findings.none("sizes taken that cannot be drawn", taken);
    findings.none("headers unlike what was asked for, values that are no light", bad);
    findings.none("errors of the device", bench.failure().empty() ? 0 : 1);
}

/// Frames of a session from the start, at one size.
std::vector<std::vector<std::byte>> fresh_frames(ServerBench& bench, const Size& size, int count)
{
    Session session = bench.session(size);
    std::vector<std::vector<std::byte>> payloads;
    for (int i = 0; i < count; ++i)
        payloads.push_back(session.draw(session.welcome().camera).payload);
    return payloads;
}

/// Every size is drawn twice: without a history, then with one of a frame.
void resized_in_midstream(Findings& findings, Length length)
{
    ServerBench bench(circling_ball());
    std::mt19937 random(68);
    std::uniform_int_distribution<std::uint32_t> side(1, 40);
    Session session = bench.session({24, 24}, {{"view", "history_length"}});
    const protocol::Pose pose = session.welcome().camera;
    double bad = 0;
    double wrong_history = 0;
    const int resizes = length == Length::kLong ? 2000 : 200;
    for (int i = 0; i < resizes; ++i) {
        const Size size{side(random), side(random)};
        session.resize(size);
        for (const float expected : {1.0F, 2.0F}) {
            const Frame frame = session.draw(pose);
            const Received received = receive(frame, size);
            bad += received.bad;
            wrong_history +=
                frame.header.has(protocol::frame_flags::kHistoryReset) == (expected == 1.0F) ? 0
                                                                                             : 1;
            // 0: sky. The ball and its edge may have come from elsewhere in the second frame.
            for (const float value : received.picture.linear)
                wrong_history += value == 0 || value == 1.0F || value == expected ? 0 : 1;
        }
    }
    // The view is the last to be named, so that the random numbers begin where a new session's do.
    session.set("view", "final");
    session.set("time", 0);
    session.resize({31, 23});
    double unlike = 0;
    for (const std::vector<std::byte>& expected : fresh_frames(bench, {31, 23}, 4))
        unlike += session.draw(pose).payload == expected ? 0 : 1;
    findings.none(
        "histories other than one frame's, then two's, " + std::to_string(resizes) + " sizes",
        wrong_history);
    findings.none("headers unlike what was asked for, values that are no light", bad);
    findings.none("frames at the last size unlike a new session's", unlike);
    findings.none("errors of the device", bench.failure().empty() ? 0 : 1);
}

/// Hours on, back, standing still; times that are none are refused and change nothing.
void jumps_in_time(Findings& findings, Length /*length*/)
{
    constexpr Size kSize{40, 30};
    ServerBench bench(circling_ball());
    Session session = bench.session(kSize);
    const protocol::Pose pose = session.welcome().camera;
    double bad = 0;
    double unlike = 0;
    double moved = 0;
    for (const double time : {0.7, 3600.0, 0.0, 1799.3, 1e-3, 3599.999}) {
        session.set("play", true);
        session.set("time", time);
        for (int i = 0; i < 3; ++i)
            bad += receive(session.draw(pose), kSize).bad;
        session.set("play", false);
        session.set("time", time);
        const Frame there = session.draw(pose, /*cut=*/true);
        bad += receive(there, kSize).bad;
        Session fresh = bench.session(kSize, {{"play", false}, {"time", time}});
        unlike += fresh.draw(pose).payload == there.payload ? 0 : 1;
        session.set("view", "motion");
        for (const float pixels : receive(session.draw(pose), kSize).picture.linear)
            moved += pixels == 0 ? 0 : 1;
        session.set("view", "final");
    }
    double taken = 0;
    for (const json& no_time : {json(-1), json(1e6), json("soon"), json(3600.001)}) {
        try {
            session.set("time", no_time);
            ++taken;
        } catch (const client::RefusedError&) {
            bad += receive(session.draw(pose), kSize).bad;
        }
    }
    findings.none("values that are no light", bad);
    findings.none("moments that look unlike a new session's", unlike);
    findings.none("motion of a scene that stands still [values]", moved);
    findings.none("times taken that are none", taken);
}

/// A cut takes nothing along, whatever was shown before.
void cut(Findings& findings, Length /*length*/)
{
    constexpr Size kSize{40, 30};
    ServerBench bench(circling_ball());
    Session session = bench.session(kSize, {{"play", false}});
    Session fresh = bench.session(kSize, {{"play", false}});
    protocol::Pose pose = session.welcome().camera;
    for (int i = 0; i < 5; ++i)
        session.draw(pose);
    pose.position[0] += 0.3;
    double unlike = 0;
    for (int i = 0; i < 4; ++i)
        unlike += session.draw(pose, i == 0).payload == fresh.draw(pose).payload ? 0 : 1;
    findings.none("frames after a cut unlike a new session's", unlike);
}

/// What one kind of frame shows after a while.
std::vector<float> shown(Session& session, const char* view, int frames)
{
    session.set("view", view);
    client::Picture picture;
    for (int i = 0; i < frames; ++i) {
        const Frame frame = session.draw(session.welcome().camera);
        picture = client::decode_picture(frame.header, frame.payload);
    }
    return picture.linear;
}

/// Whether all pixels within two of pixel (x, y) show in `a` another thing than in `b`.
bool changed_around(
    const std::vector<float>& a, const std::vector<float>& b, const Size& size, int x, int y)
{
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            const int qx = std::clamp(x + dx, 0, static_cast<int>(size[0]) - 1);
            const int qy = std::clamp(y + dy, 0, static_cast<int>(size[1]) - 1);
            const auto i =
                3 * (static_cast<std::size_t>(qy) * size[0] + static_cast<std::size_t>(qx));
            if (std::equal(a.begin() + static_cast<std::ptrdiff_t>(i),
                    a.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                    b.begin() + static_cast<std::ptrdiff_t>(i)))
                return false;
        }
    return true;
}

/// A ball and a poster, which hardly stands out from the wall, come and go by edits: they and what
/// they hid begin anew, all else goes on.
void things_come_and_go(Findings& findings, Length /*length*/)
{
    constexpr Size kSize{48, 36};
    const json without = circling_ball();
    ServerBench bench(without);
    Session session = bench.session(kSize, {{"play", false}});
    json objects = without.at("objects");
    const json guest = {{"name", "guest"}, {"material", "white"},
        {"sphere", {{"center", {-0.6, 0.9, 1}}, {"radius", 0.6}}}};
    const json poster = {{"name", "poster"}, {"material", "white"},
        {"quad",
            {{"corner", {0.4, 0.8, -1.9999}}, {"edge_u", {1.6, 0, 0}}, {"edge_v", {0, 1.4, 0}}}}};
    objects.push_back(guest);
    objects.push_back(poster);
    double new_pixels = 0;
    double stale = 0;
    double lost = 0;
    for (const json& next : {objects, without.at("objects")}) {
        const std::vector<float> before = shown(session, "position", 1);
        shown(session, "history_length", 6);
        session.edit({{"objects", next}});
        const std::vector<float> length = shown(session, "history_length", 1);
        const std::vector<float> after = shown(session, "position", 1);
        for (int y = 0; y < static_cast<int>(kSize[1]); ++y)
            for (int x = 0; x < static_cast<int>(kSize[0]); ++x) {
                const auto i =
                    3 * (static_cast<std::size_t>(y) * kSize[0] + static_cast<std::size_t>(x));
                const bool same = std::equal(after.begin() + static_cast<std::ptrdiff_t>(i),
                    after.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                    before.begin() + static_cast<std::ptrdiff_t>(i));
                const bool sky = length[i] == 0;
                if (changed_around(after, before, kSize, x, y)) {
                    new_pixels += sky ? 0 : 1;
                    stale += length[i] <= 1 ? 0 : 1;
                } else if (same && !sky) {
                    lost += length[i] >= 8 ? 0 : 1;
                }
            }
    }
    findings.at_least("pixels that show something new", new_pixels, 100);
    findings.none("of these with a history", stale);
    findings.none("pixels that show what they did, without their history", lost);
}

constexpr Case kServerCases[] = {
    {"63c", "server", "a cut", Layer::kServer, "After a cut frames are those of a new session.",
        cut},
    {"63d", "server", "things come and go", Layer::kServer,
        "What an edit brings or uncovers has no history, all else keeps its own.",
        things_come_and_go},
    {"68", "server", "any size", Layer::kServer,
        "Every pixel of every size is drawn, from 1x1 to more than 8192.", any_size},
    {"68b", "server", "other sizes in mid-stream", Layer::kServer,
        "After 200 changes of size in mid-stream no frame has an old history and the picture is "
        "that of a new session.",
        resized_in_midstream},
    {"68c", "server", "jumps in time", Layer::kServer,
        "Hours on and back the picture is that of a new session at that moment; times that are "
        "none are refused.",
        jumps_in_time},
};

constexpr Guard kServerGuards[] = {
    {"cuts_forget", "63c"},
    {"last_work_group", "68"},
    {"same_thing", "63d", "svgf/past.glsl", "identity.xy == p.ids && plane", "plane"},
    {"sizes_forget", "68b"},
};

}  // namespace

Group server_group()
{
    return {kServerCases, kServerGuards};
}

}  // namespace farlight::lab
