// Motion vectors as the G-buffer writes them, against a double-precision oracle that poses things
// by their formulas: rigid, skinned, morphed, at rest, each under a moving camera, and all
// together. The camera alone: gbuffer_test.cpp.
#include "lab/meshes.h"
#include "lab/projection.h"
#include "tests/support/gl_test.h"
#include "tests/support/moving_scenes.h"

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

namespace farlight {
namespace {

constexpr Extent kPicture{97, 61};
constexpr double kThen = 0.3;
constexpr double kNow = 0.7;
constexpr double kTolerance = 1e-3;  // [px]

/// Where the point of a thing that is at `now` at kNow was at kThen.
using Past = std::function<glm::dvec3(const glm::dvec3& now)>;

/// What hang_on_nodes() does to thing i, by hand: from a little aside to its place.
glm::dmat4 hung(std::size_t i, const glm::dmat4& place, double time)
{
    const auto n = static_cast<double>(i);
    const glm::dmat4 aside =
        glm::translate(glm::dmat4(1), (1 - time) * glm::dvec3(0.07F, -0.04F, 0.05F));
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1 + n, 2, -1));
    return place * glm::rotate(aside, (1 - time) * (0.1 + 0.05 * n), axis);
}

Past rigid(std::size_t i, const glm::dmat4& place)
{
    const glm::dmat4 moved = hung(i, place, kThen) * glm::inverse(hung(i, place, kNow));
    return [=](const glm::dvec3& p) { return glm::dvec3(moved * glm::dvec4(p, 1)); };
}

/// Where vertex i of a mesh is at a time.
using Vertices = std::function<glm::dvec3(std::size_t i, double time)>;

/// The same point of a mesh in two poses: that of the nearest triangle.
Past deforming(const Mesh& mesh, const Vertices& vertex)
{
    return [=, triangles = mesh.triangles](const glm::dvec3& p) {
        double nearest = 1e300;
        glm::dvec3 past(0);
        for (const glm::uvec3& t : triangles) {
            const glm::dvec3 a = vertex(t.x, kNow);
            const glm::dvec3 u = vertex(t.y, kNow) - a;
            const glm::dvec3 v = vertex(t.z, kNow) - a;
            const glm::dvec3 n = glm::cross(u, v);
            const double area2 = glm::dot(n, n);
            const double s = glm::dot(glm::cross(p - a, v), n) / area2;
            const double r = glm::dot(glm::cross(u, p - a), n) / area2;
            // Distance from the plane, and how far outside the edges.
            const double outside = std::max({0.0, -s, -r, s + r - 1}) * std::sqrt(std::sqrt(area2));
            const double distance = std::abs(glm::dot(p - a, n)) / std::sqrt(area2) + outside;
            if (distance < nearest) {
                nearest = distance;
                past = (1 - s - r) * vertex(t.x, kThen) + s * vertex(t.y, kThen)
                    + r * vertex(t.z, kThen);
            }
        }
        EXPECT_LT(nearest, 1e-5);
        return past;
    };
}

/// bending_bar()'s mesh, carried to `place`: the upper joint turns about z by the time in radians.
Past bending(const Mesh& mesh, const glm::dvec3& place)
{
    return deforming(mesh, [=](std::size_t i, double time) {
        const glm::dvec3 p(mesh.positions[i]);
        const glm::dvec3 turned(std::cos(time) * p.x - std::sin(time) * (p.y - 1),
            std::sin(time) * p.x + std::cos(time) * (p.y - 1) + 1, p.z);
        return place + static_cast<double>(mesh.weights[i].x) * p
            + static_cast<double>(mesh.weights[i].y) * turned;
    });
}

/// swelling_sphere()'s mesh, carried as thing i: the target's weight is the time.
Past swelling(const Mesh& mesh, std::size_t i, const glm::dmat4& place)
{
    return deforming(mesh, [=](std::size_t vertex, double time) {
        const glm::dvec3 p = glm::dvec3(mesh.positions[vertex])
            + time * glm::dvec3(mesh.morph_targets[0].positions[vertex]);
        return glm::dvec3(hung(i, place, time) * glm::dvec4(p, 1));
    });
}

glm::dvec3 stays(const glm::dvec3& p)
{
    return p;
}

/// How many of an object's pixels were seen, and on how many a renderer would be caught that took
/// the present for the past: of the thing, of the camera.
struct Caught {
    int seen = 0;
    int thing = 0;
    int camera = 0;
};

class MotionVectorsTest : public GlTest {
protected:
    static Image picture(
        View& view, const Scene& scene, DebugView which, const CameraPose& camera, double time)
    {
        RenderSettings settings;
        settings.view = which;
        RenderRequest request = linear_request(scene, kPicture, settings);
        request.camera = camera;
        request.time = time;
        return view.render(request).image;
    }

    /// Every pixel's motion from kThen to kNow, the camera moving too; `pasts` by object.
    static void expect_motion(const Scene& source, const std::vector<Past>& pasts)
    {
        const DeviceScene on_device(source);
        const Scene& scene = on_device.scene;
        const CameraPose& camera = scene.camera;
        CameraPose before = camera;
        before.position += glm::dvec3(0.05, -0.03, 0.1);
        View view(on_device.shared);
        const Image positions = picture(view, scene, DebugView::kPosition, camera, kNow);
        const Image objects = picture(view, scene, DebugView::kObjectId, camera, kNow);
        View moving(on_device.shared);
        picture(moving, scene, DebugView::kMotion, before, kThen);
        const Image motion = picture(moving, scene, DebugView::kMotion, camera, kNow);
        const double size = scene_bounds(scene).radius();
        std::map<std::size_t, Caught> caught;
        for (int y = 0; y < kPicture.height; ++y)
            for (int x = 0; x < kPicture.width; ++x) {
                const glm::dvec3 now(pixel(positions, x, y));
                if (now == glm::dvec3(0))
                    continue;
                const auto object = static_cast<std::size_t>(pixel(objects, x, y).x);
                const glm::dvec3 past = pasts.at(object)(now);
                const glm::dvec3 here = project(camera, now, kPicture);
                const glm::dvec3 expected = project(before, past, kPicture) - here;
                const glm::dvec3 found(pixel(motion, x, y));
                ASSERT_NEAR(found.x, expected.x, kTolerance) << x << "," << y;
                ASSERT_NEAR(found.y, expected.y, kTolerance) << x << "," << y;
                ASSERT_NEAR(found.z, expected.z, 1e-5 * size) << x << "," << y;
                const auto differs = [&](const glm::dvec3& other) {
                    return glm::distance(glm::dvec2(other - here), glm::dvec2(expected))
                        > 10 * kTolerance;
                };
                Caught& c = caught[object];
                ++c.seen;
                c.thing += differs(project(before, now, kPicture)) ? 1 : 0;
                c.camera += differs(project(camera, past, kPicture)) ? 1 : 0;
            }
        EXPECT_EQ(caught.size(), pasts.size()) << "an object is out of the picture";
        for (const auto& [object, c] : caught) {
            EXPECT_GT(c.seen, 20) << object;
            EXPECT_GT(c.camera, c.seen / 2) << object;
            const bool rests = scene.objects[object].name.starts_with("resting");
            EXPECT_GT(c.thing, rests ? -1 : c.seen / 2) << object;
        }
    }
};

/// Where the things of rigid_things() come to rest; one is mirrored, two are squeezed.
glm::dmat4 place_of(std::size_t i)
{
    static const glm::dvec3 kWhere[] = {
        {-2.4, 0.3, 0}, {2.2, 0.4, 0}, {-0.8, -1.4, 1}, {1.3, -1.3, 0.5}};
    static const glm::dvec3 kScale[] = {{-1.2, 0.7, 0.9}, {1, 1, 1}, {1, 1.3, 0.8}, {1.2, 0.6, 1}};
    glm::dmat4 m = glm::translate(glm::dmat4(1), kWhere[i]);
    m = glm::rotate(m, 0.2 + 0.1 * static_cast<double>(i), glm::normalize(glm::dvec3(1, 2, 0.5)));
    return glm::scale(m, kScale[i]);
}

/// One of each shape, and what each was.
Scene rigid_things(std::vector<Past>& pasts)
{
    Scene scene = scene_of(bumpy_sphere(24, 12));
    scene.objects.push_back({"ball", 0, Sphere{{0.2, 0.1, 0}, 0.7}});
    scene.objects.push_back({"plate", 0, Quad{{-0.7, -0.5, 0}, {1.3, 0.1, 0}, {0, 1, 0.2}}});
    scene.objects.push_back(
        {"coin", 0, Disk{{0, 0, 0.1}, glm::normalize(glm::dvec3(1, 2, 4)), 0.7}});
    hang_on_nodes(scene, place_of, true);
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        pasts.push_back(rigid(i, place_of(i)));
    scene.camera = {{1, 2, 9}, {0, 0, 0}, {0, 1, 0}, 40};
    return scene;
}

TEST_F(MotionVectorsTest, OfRigidThings)
{
    std::vector<Past> pasts;
    const Scene scene = rigid_things(pasts);
    expect_motion(scene, pasts);
}

TEST_F(MotionVectorsTest, OfASkin)
{
    const Scene scene = bending_bar(24, 16);
    expect_motion(scene, {bending(scene.meshes[0], glm::dvec3(0))});
}

TEST_F(MotionVectorsTest, OfAMorphAndItsCarrier)
{
    const Scene scene = swelling_sphere(24, 16);
    expect_motion(scene, {swelling(scene.meshes[0], 0, scene.animation.nodes[0].local)});
}

/// What could deform and does not moves as what cannot, and a skin's node moves nothing.
TEST_F(MotionVectorsTest, OfShapesAtRest)
{
    std::vector<NamedScene> scenes = resting_shapes();
    for (std::size_t i = 0; i < 2; ++i) {
        SCOPED_TRACE(scenes[i].what);
        expect_motion(scenes[i].scene, {rigid(0, scenes[i].scene.animation.nodes[0].local)});
    }
    SCOPED_TRACE(scenes[2].what);
    scenes[2].scene.objects[0].name = "resting bar";
    expect_motion(scenes[2].scene, {stays});
}

/// Adds another scene's one object with its mesh, nodes, skins and tracks.
void add_object(Scene& scene, const Scene& other)
{
    const auto first_node = static_cast<std::uint32_t>(scene.animation.nodes.size());
    const auto first_skin = static_cast<std::uint32_t>(scene.animation.skins.size());
    for (Node node : other.animation.nodes) {
        if (node.parent != kNone)
            node.parent += first_node;
        scene.animation.nodes.push_back(node);
    }
    for (Skin skin : other.animation.skins) {
        for (std::uint32_t& joint : skin.joints)
            joint += first_node;
        scene.animation.skins.push_back(skin);
    }
    for (Track track : other.animation.tracks) {
        track.index += track.target == Track::Target::kMorphWeights
            ? static_cast<std::uint32_t>(scene.objects.size())
            : first_node;
        scene.animation.tracks.push_back(track);
    }
    Object object = other.objects[0];
    if (object.node != kNone)
        object.node += first_node;
    auto& instance = std::get<MeshInstance>(object.shape);
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    if (instance.skin != kNone)
        instance.skin += first_skin;
    scene.meshes.push_back(other.meshes[0]);
    scene.objects.push_back(object);
}

/// Tables of several moving things: each must find its own past in them.
TEST_F(MotionVectorsTest, OfAllTogether)
{
    std::vector<Past> pasts;
    Scene scene = rigid_things(pasts);
    Scene bar = bending_bar(16, 12);
    bar.animation.nodes[0].translation = {0, -0.6, -1};
    pasts.push_back(bending(bar.meshes[0], bar.animation.nodes[0].translation));
    add_object(scene, bar);
    Scene morph = swelling_sphere(16, 12);
    morph.animation.nodes[0].local =
        glm::translate(glm::dmat4(1), {0, 2.3, -0.5}) * morph.animation.nodes[0].local;
    pasts.push_back(swelling(morph.meshes[0], 0, morph.animation.nodes[0].local));
    add_object(scene, morph);
    bar.animation.nodes[0].translation = {3.2, -2.2, 1};
    pasts.push_back(bending(bar.meshes[0], bar.animation.nodes[0].translation));
    add_object(scene, bar);
    scene.objects.push_back({"resting floor", 0, Quad{{-9, -2.5, 4}, {18, 0, 0}, {0, 0, -12}}});
    pasts.emplace_back(stays);
    expect_motion(scene, pasts);
}

}  // namespace
}  // namespace farlight
