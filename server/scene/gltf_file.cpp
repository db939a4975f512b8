// What a glTF file's scene holds, one kind of thing after the other.
#include "server/scene/gltf_file.h"

#include "server/scene/gltf_camera.h"
#include "server/scene/gltf_check.h"
#include "server/scene/gltf_extensions.h"
#include "server/scene/gltf_light.h"
#include "server/scene/gltf_material.h"
#include "server/scene/gltf_objects.h"
#include "server/scene/gltf_views.h"
#include "server/scene/json_text.h"

#include <algorithm>

namespace farlight {

namespace {

using Json = nlohmann::json;

class Reader {
public:
    explicit Reader(GltfContainer& gltf)
        : gltf_(gltf)
        , root_(gltf.root)
        , index_(gltf.document.value("scene", std::size_t(0)))
        , tree_(read_gltf_tree(gltf, index_))
        , rig_(gltf, tree_, result_.scene.animation)
    {
    }

    GltfScene read()
    {
        read_name();
        read_gltf_materials(gltf_, scene());
        read_objects();
        read_lights();
        result_.has_camera = read_gltf_cameras(gltf_, tree_, rig_, scene());
        note_the_rest();
        return std::move(result_);
    }

private:
    Scene& scene() { return result_.scene; }
    const Json& json_of(const GltfNode& node) const { return gltf_.list("nodes")[node.index]; }

    void read_name();
    void read_objects();
    void read_lights();
    void note_the_rest();

    GltfContainer& gltf_;
    ScenePlace root_;
    std::size_t index_;  // of the glTF scene
    GltfScene result_;
    GltfTree tree_;
    GltfRig rig_;
};

void Reader::read_name()
{
    scene().file = root_.file;
    scene().name = gltf_.list("scenes")[index_].value("name", "");
    if (scene().name.empty())
        scene().name = std::filesystem::path(root_.file).stem().string();
}

void Reader::read_objects()
{
    GltfObjects objects(gltf_, rig_, scene());
    for (const GltfNode& node : tree_.nodes)
        objects.add(node);
    if (scene().objects.empty() && objects.flat_instances() > 0)
        refuse(root_ / "scenes" / index_ / "nodes",
            std::to_string(objects.flat_instances())
                + " objects, all left out because their transform makes them flat, as a scale of 0 "
                  "does",
            "at least one that is not");
    if (scene().objects.empty())
        refuse(root_ / "scenes", "no mesh in the scene's nodes", "at least one");
    read_gltf_animations(gltf_, rig_, objects.by_node(), scene());
    objects.add_notes();
}

void Reader::read_lights()
{
    GltfLightCounts counts;
    std::size_t flat = 0;  // whose transform leaves no direction
    for (const GltfNode& node : tree_.nodes) {
        const Json& json = json_of(node);
        const Json* extension = gltf_extension(json, "KHR_lights_punctual");
        if (extension == nullptr)
            continue;
        PunctualLight light = read_gltf_light(gltf_, extension->at("light"), counts);
        if (light.name.empty())
            light.name = json.value("name", "");
        if (light.name.empty())
            light.name = "light " + std::to_string(scene().lights.size());
        light.node = node.carrier;
        if (place_light(light, node.carrier_from_node))
            scene().lights.push_back(std::move(light));
        else
            ++flat;
    }
    if (counts.clamped > 0)
        scene().notes.push_back(
            std::to_string(counts.clamped) + " lights with numbers outside their range clamped");
    if (counts.with_range > 0)
        scene().notes.push_back(std::to_string(counts.with_range)
            + " lights with a range: light has none here, it falls off with the square of the "
              "distance");
    if (flat > 0)
        scene().notes.push_back(
            std::to_string(flat) + " lights left out: a scale of 0 leaves no direction");
}

void Reader::note_the_rest()
{
    if (tree_.changed_rotations > 0)
        scene().notes.push_back(std::to_string(tree_.changed_rotations)
            + " nodes' rotations that were no unit quaternions brought to length 1");
    std::string unread;
    for (const std::string& name : unread_gltf_extensions(gltf_.document))
        unread.append(unread.empty() ? "" : ", ").append(name);
    if (!unread.empty())
        scene().notes.push_back("extensions that are not read: " + unread);
}

}  // namespace

bool is_gltf(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
        [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".gltf" || extension == ".glb";
}

GltfScene load_gltf(const std::filesystem::path& file)
{
    return parse_gltf(read_file(file), file);
}

GltfScene parse_gltf(std::string bytes, const std::filesystem::path& file)
{
    GltfContainer gltf = open_gltf_container(std::move(bytes), file);
    check_gltf(gltf);
    read_gltf_views(gltf);
    return Reader(gltf).read();
}

}  // namespace farlight
