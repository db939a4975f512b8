// MovingScene: what of a packed scene follows time: transforms of instances, vertices that deform,
// the tree above them, and the lights they carry. A pure function of time; needs no GL.
#pragma once

#include "server/scene/deforming_mesh.h"
#include "server/scene/top_level.h"

#include <memory>
#include <optional>

namespace farlight {

class MovingScene {
public:
    /// `trees`: one a group of `flat`, within `nodes`. `meshes` fill `deforming`.
    MovingScene(const Scene& scene, const FlatScene& flat, std::span<const TreePlace> trees,
        std::span<const glm::uvec4> nodes, std::vector<DeformingMesh> meshes,
        DeformingTables deforming);

    /// Stack that traversal needs at any time.
    int stack_depth() const { return stack_depth_; }

    struct Changes {
        bool now = false;  ///< What depends on the time.
        bool previous = false;  ///< What depends on the previous time.
    };
    /// Brings everything to `time` and the prev_ tables to `prev_time` [s], counted from `origin`:
    /// zero unless the scene is wide().
    Changes pose(double time, double prev_time, const glm::dvec3& origin = glm::dvec3(0));
    /// Nothing of it has a place of its own in the tables: see scene_origin.h.
    bool wide() const { return wide_; }

    /// The first texels of bvh_nodes; empty where the world's own tree is all there is.
    const Texels& top_level() const { return top_level_; }
    const Texels& instances() const { return instance_texels_; }
    /// Empty where no instance moves.
    const Texels& prev_instances() const { return prev_instance_texels_; }
    const DeformingTables& deforming() const { return deforming_; }
    /// The area lights, where they are now.
    const std::vector<Light>& lights() const { return lights_; }
    const std::vector<glm::dmat4>& world_from_node() const { return now_->world_from_node; }

private:
    struct Instance {
        std::uint32_t object = 0;
        std::uint32_t light = 0;  ///< Index + 1 of its first.
        std::uint32_t root = 0;  ///< Texel in bvh_nodes.
        PrimitiveBounds bounds{};  ///< In the group's space.
    };
    /// All that depends on time and origin alone.
    struct Moment {
        double time = 0;
        glm::dvec3 origin{0};
        std::vector<glm::dmat4> world_from_node;
        std::vector<glm::dmat4> world_from_group;  ///< One an instance.
        std::vector<VertexPose> vertices;  ///< One a deforming mesh.
    };

    std::shared_ptr<const Moment> moment(double time, const glm::dvec3& origin) const;
    void pack_now();
    void pack_previous();
    void pack_instance(std::size_t i);
    void rebuild_top_level();

    Scene scene_;  ///< Objects, animation, and the meshes that deform.
    std::vector<FlatInstanceLight> instance_lights_;
    std::vector<Light> lights_;
    std::vector<Instance> instances_;
    std::vector<DeformingMesh> meshes_;
    DeformingTables deforming_;
    std::optional<TopLevelEntry> world_;
    std::shared_ptr<const Moment> now_;
    std::shared_ptr<const Moment> prev_;
    Texels top_level_;
    Texels instance_texels_;
    Texels prev_instance_texels_;
    int stack_depth_ = 0;
    bool wide_ = false;
};

}  // namespace farlight
