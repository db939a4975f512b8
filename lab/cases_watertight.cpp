// Watertight: rays through meshes whose triangles share edges and vertices, and triangles that
// hardly are any.
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/ray_probe.h"

#include "server/scene/mesh_repair.h"

#include <algorithm>

namespace farlight::lab {
namespace {

enum class Aim : std::uint8_t { kVertex, kEdge, kAnywhere };

/// A closed mesh and where in it rays start.
struct ClosedMesh {
    std::string name;
    Mesh mesh;
    glm::vec3 center;
    float room;  ///< Rays start within this on each axis.
};

/// Faces on the planes x, y, z = -1 and 1 around `center`, each of n x n squares: tree boxes end
/// where triangles do.
Mesh subdivided_cube(int n, const glm::vec3& center)
{
    Mesh mesh{"cube", {}, {}, {}};
    for (int face = 0; face < 6; ++face) {
        const int axis = face % 3;
        const float side = face < 3 ? -1.0F : 1.0F;
        const auto first = static_cast<unsigned>(mesh.positions.size());
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                glm::vec3 p(0);
                p[axis] = side;
                p[(axis + 1) % 3] = 2.0F * static_cast<float>(i) / static_cast<float>(n) - 1;
                p[(axis + 2) % 3] = 2.0F * static_cast<float>(j) / static_cast<float>(n) - 1;
                mesh.positions.push_back(center + p);
            }
        const auto at = [&](int i, int j) {
            return first + static_cast<unsigned>(j * (n + 1) + i);
        };
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
                mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
            }
    }
    return mesh;
}

/// `mesh` times `scale`, then moved to `center`, vertex by vertex in single precision.
Mesh placed(Mesh mesh, float scale, const glm::vec3& center)
{
    for (glm::vec3& p : mesh.positions)
        p = center + scale * p;
    return mesh;
}

std::vector<ClosedMesh> closed_meshes()
{
    std::vector<ClosedMesh> meshes;
    meshes.push_back({"at the origin", bumpy_sphere(120, 60), glm::vec3(0), 0.25F});
    meshes.push_back(
        {"1e3 away", bumpy_sphere(120, 60, {1e3F, -500, 250}), {1e3F, -500, 250}, 0.25F});
    // Where Embree's own tests put theirs; edges are some 30 ulp long.
    const glm::vec3 embree(148376, 1234, -223423);
    meshes.push_back(
        {"10 m wide, 2.7e5 away", placed(bumpy_sphere(120, 60), 10, embree), embree, 2.5F});
    meshes.push_back(
        {"cube along the axes", subdivided_cube(24, glm::vec3(0)), glm::vec3(0), 0.25F});
    meshes.push_back({"cube, off by a third", subdivided_cube(24, glm::vec3(1.0F / 3)),
        glm::vec3(1.0F / 3), 0.25F});
    return meshes;
}

/// Rays from inside, all of which must meet the mesh.
std::vector<TestRay> rays_from_inside(const ClosedMesh& closed, Aim aim, std::size_t count)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<TestRay> rays;
    while (rays.size() < count) {
        const glm::uvec3 corners = closed.mesh.triangles[random() % closed.mesh.triangles.size()];
        const glm::vec3& a = closed.mesh.positions[corners.x];
        const glm::vec3& b = closed.mesh.positions[corners.y];
        const glm::vec3 origin = closed.center
            + closed.room
                * (2.0F * glm::vec3(uniform(random), uniform(random), uniform(random)) - 1.0F);
        const glm::vec3 target = aim == Aim::kVertex ? a : glm::mix(a, b, uniform(random));
        rays.push_back({origin,
            aim == Aim::kAnywhere ? random_direction(random) : glm::normalize(target - origin)});
    }
    return rays;
}

void no_ray_slips_out(Findings& findings, Length length)
{
    constexpr std::pair<Aim, const char*> kAims[] = {
        {Aim::kVertex, "vertices"}, {Aim::kEdge, "edges"}, {Aim::kAnywhere, "anywhere"}};
    // A million in all meshes together, or in each.
    const std::size_t count = length == Length::kLong ? 333'334 : 66'667;
    for (const ClosedMesh& closed : closed_meshes()) {
        const DeviceScene scene(scene_of(closed.mesh));
        const RayProbe probe(scene);
        for (const auto& [aim, towards] : kAims) {
            std::size_t missed = 0;
            for (const ProbeHit& hit : probe.by_tree(rays_from_inside(closed, aim, count)))
                missed += hit.met() && hit.any ? 0 : 1;
            findings.none(closed.name + ": rays at " + towards + " that meet nothing",
                static_cast<double>(missed));
        }
    }
}

/// The triangles that accept a ray at an edge: one, or the two that share it.
void an_edge_is_met_once(Findings& findings, Length length)
{
    const std::size_t count = length == Length::kLong ? 50'000 : 4'000;
    const ClosedMesh closed{"", bumpy_sphere(24, 12), glm::vec3(0), 0.25F};
    const DeviceScene scene(scene_of(closed.mesh));
    const RayProbe probe(scene);
    int least = 9;
    int most = 0;
    int twice = 0;
    std::size_t elsewhere = 0;
    const std::vector<TestRay> rays = rays_from_inside(closed, Aim::kEdge, count);
    const std::vector<ProbeHit> all = probe.by_every_primitive(rays);
    const std::vector<ProbeHit> nearest = probe.by_tree(rays);
    for (std::size_t i = 0; i < all.size(); ++i) {
        least = std::min(least, all[i].accepted);
        most = std::max(most, all[i].accepted);
        twice += all[i].accepted > 1 ? 1 : 0;
        elsewhere += std::abs(nearest[i].t - all[i].t) <= 16 * 6e-8 * all[i].t ? 0 : 1;
    }
    findings.at_least("triangles that a ray at an edge goes through, least", least, 1);
    findings.at_most("most", most, 2);
    findings.at_most(
        "share of such rays that go through two", twice / static_cast<double>(count), 0.5);
    findings.none("nearest hits elsewhere than either", static_cast<double>(elsewhere));
}

/// 1e-12 wide: the square of the cross product is below the smallest float. It fills the picture.
Scene sliver(bool moving)
{
    Scene scene;
    scene.materials.push_back({"white", glm::vec3(0.5F), glm::vec3(0.25F), true});
    scene.meshes.push_back(
        {"sliver", {{-6e-13F, -4e-13F, 0}, {6e-13F, -4e-13F, 0}, {0, 8e-13F, 0}}, {}, {{0, 1, 2}}});
    scene.objects.push_back({"sliver", 0, MeshInstance{}});
    scene.background = glm::vec3(1);
    scene.camera = {{0, 0, 2e-13}, {0, 0, 0}, {0, 1, 0}, 45};
    if (moving) {
        scene.animation.nodes.emplace_back();
        Track track;
        track.times = {0, 1};
        track.values = {0, 0, 0, 0, 0, 1e-13F};
        scene.animation.tracks.push_back(track);
        scene.objects[0].node = 0;
    }
    return scene;
}

void sliver_faces_whoever_looks(Findings& findings, Length /*length*/)
{
    constexpr Extent kRows{16, 9};
    for (const bool moving : {false, true}) {
        const DeviceScene scene(sliver(moving));
        const auto frame_of = [&](DebugView which) {
            RenderRequest request = linear_request(scene.scene, kRows, {});
            request.settings.denoiser = Denoiser::kOff;
            request.settings.antialiasing = false;
            request.settings.view = which;
            View view(scene.shared);
            return view.render(request);
        };
        const RenderedFrame shown = frame_of(DebugView::kFinal);
        const RenderedFrame normals = frame_of(DebugView::kGeometricNormal);
        const RenderedFrame depth = frame_of(DebugView::kDepth);
        double off = 0;
        double not_unit = 0;
        double darkest = 1;
        for (int x = 0; x < kRows.width; ++x) {
            const glm::vec3 normal = pixel(normals.image, x, 4);
            off = farther(off, std::abs(pixel(depth.image, x, 4).x / 2e-13 - 1));
            not_unit = farther(not_unit,
                static_cast<double>(normal.z > 0 ? std::abs(glm::length(normal) - 1) : 1.0F));
            darkest = std::min(darkest, static_cast<double>(pixel(shown.image, x, 4).x));
        }
        const std::string name = moving ? "moving: " : "at rest: ";
        findings.none(name + "non-finite values", shown.bad_values.all());
        findings.at_most(name + "depth off, relative", off, 1e-3);
        findings.at_most(name + "normal is not a unit towards the viewer", not_unit, 1e-3);
        // It emits 0.25 and reflects the sky besides.
        findings.at_least(name + "darkest pixel", darkest, 0.26);
    }
}

/// Triangles on a line, as a file may hold them, all over a mesh: the loader's repair leaves the
/// rest as it was.
void triangles_without_area_do_not_show(Findings& findings, Length length)
{
    const Mesh plain = bumpy_sphere(60, 30);
    Mesh spoilt = plain;
    spoilt.triangles.clear();
    std::mt19937 random(8);
    std::size_t added = 0;
    for (const glm::uvec3& triangle : plain.triangles) {
        spoilt.triangles.push_back(triangle);
        if (random() % 100 == 0) {
            spoilt.triangles.emplace_back(triangle.x, triangle.y, triangle.y);
            // pbrt's (BadCases): three points on a line.
            const auto first = static_cast<unsigned>(spoilt.positions.size());
            for (const glm::vec3 p : {glm::vec3(-1113.45459F, -79.049614F, -56.2431908F),
                     glm::vec3(-1113.45459F, -87.0922699F, -56.2431908F),
                     glm::vec3(-1113.45459F, -79.2090149F, -56.2431908F)})
                spoilt.positions.push_back(p);
            spoilt.triangles.emplace_back(first, first + 1, first + 2);
            added += 2;
        }
    }
    const MeshRepairs repairs = repair_mesh(spoilt);
    findings.none("triangles without area not left out, of " + std::to_string(added),
        static_cast<double>(added) - static_cast<double>(repairs.zero_area_triangles));
    const DeviceScene clean(scene_of(plain));
    const DeviceScene repaired(scene_of(spoilt));
    const std::vector<TestRay> rays =
        random_rays(scene_bounds(clean.scene), length == Length::kLong ? 200'000 : 20'000, 9);
    const std::vector<ProbeHit> expected = RayProbe(clean).by_tree(rays);
    const std::vector<ProbeHit> found = RayProbe(repaired).by_tree(rays);
    std::size_t different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
        different += found[i].t == expected[i].t && found[i].slot == expected[i].slot ? 0 : 1;
    findings.none("rays that find something else", static_cast<double>(different));
}

constexpr Case kWatertightCases[] = {
    {"1", "watertight", "no ray slips between triangles", Layer::kFunction,
        "From inside a closed mesh every ray meets it, at whatever vertex or edge it is aimed.",
        no_ray_slips_out},
    {"2", "watertight", "an edge is met once", Layer::kFunction,
        "A ray at an edge goes through one of its triangles or both, through no third, and the "
        "nearest hit is one of theirs.",
        an_edge_is_met_once},
    {"3", "watertight", "a sliver faces whoever looks", Layer::kPicture,
        "A triangle in which single precision finds no area has a normal and reflects light.",
        sliver_faces_whoever_looks},
    {"3b", "watertight", "triangles without area do not show", Layer::kFunction,
        "A mesh sprinkled with triangles on a line is the same to every ray as without them.",
        triangles_without_area_do_not_show},
};

constexpr Guard kWatertightGuards[] = {
    {"zero_is_inside", "1 2", "geometry/ray.glsl",
        "const bool outside = (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0);",
        "const bool outside = (u <= 0.0 || v <= 0.0 || w <= 0.0) && (u >= 0.0 || v >= 0.0 || w >= "
        "0.0);"},
    {"widened_boxes", "1", "geometry/traverse.glsl", " * 1.0000004;", ";"},
    {"repair_drops_no_area", "3b"},
    {"sliver_normal", "3", "geometry/surface.glsl",
        "dot(across, across) > 0.0 ? across : -ray.direction", "across"},
};

}  // namespace

Group watertight_group()
{
    return {kWatertightCases, kWatertightGuards};
}

}  // namespace farlight::lab
