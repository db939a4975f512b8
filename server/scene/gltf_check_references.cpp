// Reference: glTF 2.0 specification, section 3.5 "Scenes" for what a tree of nodes is.
#include "server/scene/gltf_check.h"

#include <algorithm>

namespace farlight {

namespace {

using Json = nlohmann::json;

class ReferenceChecker {
public:
    explicit ReferenceChecker(const GltfContainer& gltf) : gltf_(gltf), root_(gltf.root) { }

    void check() const
    {
        index(gltf_.document, "scene", "scenes", root_);
        each("scenes", &ReferenceChecker::check_scene);
        each("nodes", &ReferenceChecker::check_node);
        check_parents();
        each("textures", &ReferenceChecker::check_texture);
        each("images", &ReferenceChecker::check_image);
        each("cameras", &ReferenceChecker::check_camera);
        each("skins", &ReferenceChecker::check_skin);
        each("animations", &ReferenceChecker::check_animation);
    }

private:
    using Check = void (ReferenceChecker::*)(const Json&, const ScenePlace&) const;

    void each(const char* name, Check check_one) const
    {
        for (std::size_t i = 0; i < gltf_.list(name).size(); ++i)
            (this->*check_one)(gltf_.list(name)[i], root_ / name / i);
    }

    void index(const Json& object, const char* key, const char* into, const ScenePlace& place) const
    {
        if (object.contains(key))
            gltf_.item(into, object.at(key), place / key);
    }

    void indices(
        const Json& object, const char* key, const char* into, const ScenePlace& place) const
    {
        const auto found = object.find(key);
        for (std::size_t i = 0; found != object.end() && i < found->size(); ++i)
            gltf_.item(into, (*found)[i], place / key / i);
    }

    void index_of(
        const Json& list, const char* name, const Json& index, const ScenePlace& place) const
    {
        if (index.get<std::uint64_t>() >= list.size())
            refuse(place, "index " + index.dump(),
                "less than " + std::to_string(list.size()) + ", the number of " + name);
    }

    void check_scene(const Json& scene, const ScenePlace& place) const
    {
        indices(scene, "nodes", "nodes", place);
    }
    void check_node(const Json& node, const ScenePlace& place) const;
    void check_parents() const;
    void check_texture(const Json& texture, const ScenePlace& place) const
    {
        index(texture, "source", "images", place);
        index(texture, "sampler", "samplers", place);
    }
    void check_image(const Json& image, const ScenePlace& place) const
    {
        index(image, "bufferView", "bufferViews", place);
    }
    void check_camera(const Json& camera, const ScenePlace& place) const
    {
        if (const auto type = camera["type"].get<std::string>(); !camera.contains(type))
            refuse(place, "no key " + camera["type"].dump(), "what its type says");
    }
    void check_skin(const Json& skin, const ScenePlace& place) const;
    void check_animation(const Json& animation, const ScenePlace& place) const;

    const GltfContainer& gltf_;
    ScenePlace root_;
};

void ReferenceChecker::check_node(const Json& node, const ScenePlace& place) const
{
    index(node, "mesh", "meshes", place);
    index(node, "camera", "cameras", place);
    index(node, "skin", "skins", place);
    indices(node, "children", "nodes", place);
    constexpr const char* kLights = "KHR_lights_punctual";
    if (const Json* light = gltf_extension(node, kLights)) {
        const Json* all = gltf_extension(gltf_.document, kLights);
        index_of(all == nullptr ? Json() : all->value("lights", Json()), "lights",
            light->at("light"), place / "extensions" / kLights / "light");
    }
}

/// Each node has one parent at most, and none is below itself.
void ReferenceChecker::check_parents() const
{
    constexpr std::size_t kNoNode = ~std::size_t(0);
    const Json& nodes = gltf_.list("nodes");
    std::vector<std::size_t> parent(nodes.size(), kNoNode);
    std::vector<std::size_t> place_there(nodes.size());
    const auto refuse_twice = [&](std::size_t child, std::size_t of, std::size_t place) {
        refuse(root_ / "nodes" / of / "children" / place,
            "node " + std::to_string(child) + " a second time",
            "a tree: no cycles, one parent a node");
    };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Json children = nodes[i].value("children", Json::array());
        for (std::size_t k = 0; k < children.size(); ++k) {
            const auto child = children[k].get<std::size_t>();
            if (parent[child] != kNoNode)
                refuse_twice(child, i, k);
            parent[child] = i;
            place_there[child] = k;
        }
    }
    std::vector<std::size_t> seen_from(nodes.size(), kNoNode);  // each node is climbed over once
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::size_t at = i;
        for (; at != kNoNode && seen_from[at] == kNoNode; at = parent[at])
            seen_from[at] = i;
        if (at != kNoNode && seen_from[at] == i)
            refuse_twice(at, parent[at], place_there[at]);
    }
}

void ReferenceChecker::check_skin(const Json& skin, const ScenePlace& place) const
{
    if (skin["joints"].empty())
        refuse(place / "joints", "no joints", "at least one joint");
    indices(skin, "joints", "nodes", place);
    index(skin, "skeleton", "nodes", place);
    index(skin, "inverseBindMatrices", "accessors", place);
}

void ReferenceChecker::check_animation(const Json& animation, const ScenePlace& place) const
{
    const Json& samplers = animation["samplers"];
    for (std::size_t i = 0; i < samplers.size(); ++i) {
        index(samplers[i], "input", "accessors", place / "samplers" / i);
        index(samplers[i], "output", "accessors", place / "samplers" / i);
    }
    const Json& channels = animation["channels"];
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const ScenePlace here = place / "channels" / i;
        index(channels[i]["target"], "node", "nodes", here / "target");
        index_of(samplers, "samplers", channels[i]["sampler"], here / "sampler");
    }
}

}  // namespace

void check_gltf_references(const GltfContainer& gltf)
{
    ReferenceChecker(gltf).check();
}

}  // namespace farlight
