// Every object's shape in the space of its group.
#include "server/scene/flatten.h"

#include "server/host_guard.h"
#include "server/scene/deform.h"
#include "server/scene/instance_transform.h"
#include "server/scene/material_response.h"
#include "server/scene/scene_origin.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <utility>

namespace farlight {
namespace {

const HostGuard flat_drops_unbounded("flat_drops_unbounded");
const HostGuard holes_are_not_drawn("holes_are_not_drawn");

const Mesh* mesh_of(const Scene& scene, const Object& object)
{
    const auto* instance = std::get_if<MeshInstance>(&object.shape);
    return instance == nullptr ? nullptr : &scene.meshes[instance->mesh];
}

glm::vec3 transformed_point(const glm::dmat4& m, const glm::dvec3& p)
{
    return glm::vec3(m * glm::dvec4(p, 1));
}

/// Whether rays can be taken into the space of everything at rest. What a transform has squeezed
/// flat is seen, but only where its triangles are in the world.
bool can_be_instances(const Scene& scene)
{
    const std::vector<bool> moving = moving_nodes(scene.animation);
    const std::vector<glm::dmat4> world_from_node = pose_nodes(scene.animation, 0);
    return std::all_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        return (object.node != kNone && moving[object.node]) || has_pose(scene, object)
            || is_invertible(carried(object.node, world_from_node, placement_of(object)));
    });
}

class Flattener {
public:
    explicit Flattener(const Scene& scene)
        : scene_(scene)
        , wide_(is_wide(scene) && can_be_instances(scene))
        , placements_(placements_of(scene, wide_))
        , world_from_node_(pose_nodes(scene.animation, 0))
    {
        flat_.wide = wide_;
        flat_.groups.resize(1);
        flat_.objects.resize(scene.objects.size());
    }

    FlatScene run()
    {
        for (const Placement placement :
            {Placement::kWorld, Placement::kInstance, Placement::kDeforming}) {
            if (placement == Placement::kDeforming)
                flat_.first_deforming = static_cast<std::uint32_t>(flat_.groups.size());
            for (object_ = 0; object_ < scene_.objects.size(); ++object_)
                if (placements_[object_] == placement && is_there())
                    add_object(placement);
        }
        return std::move(flat_);
    }

private:
    const Object& object() const { return scene_.objects[object_]; }
    bool is_there() const
    {
        return !is_all_hole(scene_.materials[object().material]) || !holes_are_not_drawn;
    }
    glm::dmat4 world_from_carrier() const
    {
        return carried(object().node, world_from_node_, glm::dmat4(1));
    }

    void add_object(Placement placement)
    {
        in_instance_ = placement == Placement::kInstance;
        if (in_instance_)
            return add_instance();
        if (placement == Placement::kDeforming) {
            flat_.deforming_objects.push_back(object_);
            flat_.groups.emplace_back();
        }
        group_ = placement == Placement::kWorld ? 0 : flat_.groups.size() - 1;
        add_shape(world_from_carrier());
    }

    void add_instance()
    {
        const auto* mesh = std::get_if<MeshInstance>(&object().shape);
        const auto known = mesh == nullptr ? group_of_mesh_.end() : group_of_mesh_.find(mesh->mesh);
        if (known == group_of_mesh_.end()) {
            group_ = flat_.groups.size();
            flat_.groups.emplace_back();
            if (mesh != nullptr)
                group_of_mesh_[mesh->mesh] = group_;
            next_light_ = 1;
            add_shape(mesh != nullptr ? glm::dmat4(1) : glm::inverse(placement_of(object())));
        } else {
            group_ = known->second;
            flat_.objects[object_].mesh = &scene_.meshes[mesh->mesh];
        }
        if (group().size() == 0)
            return;
        const std::uint32_t light = is_sampled(scene_, object())
            ? add_instance_lights(world_from_carrier() * placement_of(object()))
            : 0;
        flat_.instances.push_back({static_cast<std::uint32_t>(group_), object_, light});
    }

    /// Lights of the group as the object's material has them shine; index + 1 of the first.
    std::uint32_t add_instance_lights(const glm::dmat4& world_from_group)
    {
        std::uint32_t first = 0;
        for (const Light& shape : lights_of_group()) {
            const std::uint32_t number = add_light(transformed(shape, world_from_group));
            first = first == 0 ? number : first;
            flat_.instance_lights.push_back(
                {number - 1, static_cast<std::uint32_t>(flat_.instances.size()), shape});
        }
        return first;
    }

    std::vector<Light> lights_of_group()
    {
        const glm::dvec3 anchor(placement_of(object())[3]);
        if (const auto* quad = std::get_if<Quad>(&object().shape))
            return {light_of_quad(glm::vec3(quad->corner - anchor), glm::vec3(quad->edge_u),
                glm::vec3(quad->edge_v))};
        if (const auto* sphere = std::get_if<Sphere>(&object().shape))
            return {light_of(Sphere{sphere->center - anchor, sphere->radius})};
        if (const auto* disk = std::get_if<Disk>(&object().shape))
            return {light_of(Disk{disk->center - anchor, disk->normal, disk->radius})};
        std::vector<Light> lights;
        for (const FlatTriangle& triangle : group().triangles) {
            const auto& [a, b, c] = triangle.vertices;
            lights.push_back(light_of_triangle(a, b - a, c - a));
            lights.back().face = triangle.face;
        }
        return lights;
    }

    void add_shape(const glm::dmat4& group_from_carrier)
    {
        std::visit([&](const auto& shape) { add(shape, group_from_carrier); }, object().shape);
    }

    void add(const Sphere& sphere, const glm::dmat4& m)
    {
        const Sphere placed{
            glm::dvec3(m * glm::dvec4(sphere.center, 1)), sphere.radius * scale_of(m)};
        group().spheres.push_back({glm::vec3(placed.center), static_cast<float>(placed.radius),
            object_, light(light_of(placed))});
    }

    void add(const Disk& disk, const glm::dmat4& m)
    {
        const Disk placed{glm::dvec3(m * glm::dvec4(disk.center, 1)),
            glm::normalize(glm::dmat3(m) * disk.normal), disk.radius * scale_of(m)};
        group().disks.push_back({glm::vec3(placed.center), static_cast<float>(placed.radius),
            glm::vec3(placed.normal), object_, light(light_of(placed))});
    }

    void add(const Quad& quad, const glm::dmat4& m)
    {
        const glm::vec3 p0 = transformed_point(m, quad.corner);
        // A mirroring carrier would turn the normal round.
        const bool mirrored = glm::determinant(glm::dmat3(m)) < 0;
        const glm::dvec3& first = mirrored ? quad.edge_v : quad.edge_u;
        const glm::dvec3& second = mirrored ? quad.edge_u : quad.edge_v;
        const glm::vec3 u = transformed_point(m, quad.corner + first);
        const glm::vec3 v = transformed_point(m, quad.corner + second);
        const glm::vec3 uv = transformed_point(m, quad.corner + quad.edge_u + quad.edge_v);
        flat_.objects[object_].mirrored = mirrored;
        Light shape = light_of_quad(p0, u - p0, v - p0);
        shape.mirrored = mirrored;
        const std::uint32_t index = light(shape);
        add_triangle({{p0, u, uv}, object_, index, 0});
        add_triangle({{p0, uv, v}, object_, index, 1});
    }

    void add(const MeshInstance& instance, const glm::dmat4& group_from_carrier)
    {
        FlatObject& flat = flat_.objects[object_];
        flat.mesh = &scene_.meshes[instance.mesh];
        const glm::dmat4 placed = group_from_carrier * instance.world_from_object;
        if (!in_instance_) {
            flat.group_from_mesh = placed;
            flat.mirrored = glm::determinant(glm::dmat3(placed)) < 0;
        }
        if (!in_instance_ && has_pose(scene_, object()))
            take_pose(flat, instance);
        flat.group_from_normal = glm::mat3(glm::inverseTranspose(glm::dmat3(flat.group_from_mesh)));
        for (std::uint32_t face = 0; face < flat.mesh->triangles.size(); ++face) {
            FlatTriangle triangle{{}, object_, 0, face};
            const glm::uvec3 corners = corners_of(flat, face);
            for (int k = 0; k < 3; ++k)
                triangle.vertices[static_cast<std::size_t>(k)] =
                    transformed_point(flat.group_from_mesh, flat.mesh->positions[corners[k]]);
            const auto& [a, b, c] = triangle.vertices;
            if (!add_triangle(triangle))
                continue;
            Light shape = light_of_triangle(a, b - a, c - a);
            shape.face = face;
            shape.mirrored = flat.mirrored;
            group().triangles.back().light = light(shape);
        }
    }

    /// Its vertices of time 0 stand in for the mesh's.
    void take_pose(FlatObject& flat, const MeshInstance& instance)
    {
        VertexPose pose = pose_object(scene_, object_, 0, world_from_node_);
        auto posed = std::make_shared<Mesh>(*flat.mesh);
        posed->positions = std::move(pose.positions);
        posed->normals = std::move(pose.normals);
        posed->tangents = std::move(pose.tangents);
        if (is_skinned(scene_, object())) {
            const Skin& skin = scene_.animation.skins[instance.skin];
            const glm::dmat4 joint =
                world_from_node_[skin.joints.front()] * skin.joint_from_mesh.front();
            flat.mirrored = glm::determinant(glm::dmat3(joint)) < 0;
        }
        flat.mesh = posed.get();
        flat.posed = std::move(posed);
        flat.group_from_mesh = glm::dmat4(1);
    }

    /// False for what can never be hit.
    bool add_triangle(const FlatTriangle& triangle)
    {
        const bool usable =
            has_area(triangle.vertices) || placements_[object_] == Placement::kDeforming;
        if (usable)
            group().triangles.push_back(triangle);
        flat_.dropped_triangles += usable ? 0 : 1;
        return usable;
    }

    /// The number a primitive goes by: index + 1 of its light, 0 when it emits nothing worth
    /// choosing; within a group of instances a count from 1.
    std::uint32_t light(Light shape)
    {
        if (in_instance_)
            return next_light_++;
        return is_sampled(scene_, object()) ? add_light(shape) : 0;
    }

    std::uint32_t add_light(Light light)
    {
        // What moves may gain or lose its area, and an instance's lights are counted.
        if (!(light.area > 0) && placements_[object_] == Placement::kWorld)
            return 0;
        light.object = object_;
        flat_.lights.push_back(light);
        return static_cast<std::uint32_t>(flat_.lights.size());
    }

    FlatGroup& group() { return flat_.groups[group_]; }

    const Scene& scene_;
    bool wide_;
    std::vector<Placement> placements_;
    std::vector<glm::dmat4> world_from_node_;
    std::map<std::uint32_t, std::size_t> group_of_mesh_;
    std::uint32_t object_ = 0;
    std::size_t group_ = 0;
    bool in_instance_ = false;
    std::uint32_t next_light_ = 1;  ///< In the group of instances being filled.
    FlatScene flat_;
};

}  // namespace

glm::dmat4 placement_of(const Object& object)
{
    if (const auto* mesh = std::get_if<MeshInstance>(&object.shape))
        return mesh->world_from_object;
    if (object.node != kNone)
        return glm::dmat4(1);
    const auto* sphere = std::get_if<Sphere>(&object.shape);
    const auto* disk = std::get_if<Disk>(&object.shape);
    return glm::translate(glm::dmat4(1),
        sphere != nullptr     ? sphere->center
            : disk != nullptr ? disk->center
                              : std::get<Quad>(object.shape).corner);
}

std::vector<Placement> placements_of(const Scene& scene, bool wide)
{
    const std::vector<bool> moving = moving_nodes(scene.animation);
    const std::vector<glm::dmat4> world_from_node = pose_nodes(scene.animation, 0);
    std::vector<Placement> placements;
    std::map<const Mesh*, std::size_t> shown;  // by objects at rest
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const bool moves =
            object.node != kNone && moving[object.node] && !is_skinned(scene, object);
        const bool round = std::holds_alternative<Sphere>(object.shape)
            || std::holds_alternative<Disk>(object.shape);
        const bool squeezed = round && object.node != kNone
            && !is_similarity(glm::dmat3(world_from_node[object.node]));
        if (changes_shape(scene, i, moving) || ((moves || wide) && has_pose(scene, object)))
            placements.push_back(Placement::kDeforming);
        else
            placements.push_back(
                moves || squeezed || wide ? Placement::kInstance : Placement::kWorld);
        if (placements.back() == Placement::kWorld && !has_pose(scene, object))
            ++shown[mesh_of(scene, object)];
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Mesh* mesh = mesh_of(scene, scene.objects[i]);
        if (mesh != nullptr && placements[i] == Placement::kWorld
            && !has_pose(scene, scene.objects[i])
            && (shown[mesh] - 1) * mesh->triangles.size() >= kSharedTriangles)
            placements[i] = Placement::kInstance;
    }
    return placements;
}

glm::uvec3 corners_of(const FlatObject& object, std::uint32_t face)
{
    return wound(object.mesh->triangles[face], object.mirrored);
}

bool has_area(const std::array<glm::vec3, 3>& vertices)
{
    const auto& [a, b, c] = vertices;
    const double area =
        glm::length(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
    return area > 0 && (std::isfinite(area) || !flat_drops_unbounded);
}

FlatScene flatten(const Scene& scene)
{
    return Flattener(scene).run();
}

}  // namespace farlight
