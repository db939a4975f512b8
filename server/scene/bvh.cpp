// Embree builds the tree; here it is packed into texels, children next to their parent's word.
#include "server/scene/bvh.h"

#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <embree3/rtcore.h>
#include <memory>
#include <stdexcept>
#include <string>

namespace farlight {
namespace {

/// Of a leaf's word, by PrimitiveKind.
constexpr std::array<unsigned, kPrimitiveKinds> kLeafKind{BVH_TRIANGLES, BVH_SPHERES, BVH_DISKS};

/// A node while Embree builds it; lives in Embree's arena.
struct BuildNode {
    unsigned count = 0;  ///< Children of an inner node, primitives of a leaf.
    bool leaf = false;
    std::array<RTCBounds, kBvhWidth> bounds;
    std::array<BuildNode*, kBvhWidth> children;
    std::array<unsigned, kBvhMaxLeaf> primitives;
};

struct Device {
    RTCDevice device = rtcNewDevice(nullptr);
    ~Device() { rtcReleaseDevice(device); }
};

struct Tree {
    RTCBVH arena = nullptr;
    BuildNode* root = nullptr;
    RTCBounds bounds{};
};

BuildNode* new_node(RTCThreadLocalAllocator allocator)
{
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode();
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned count, void*)
{
    BuildNode* node = new_node(allocator);
    node->count = count;
    return node;
}

void set_children(void* node, void** children, unsigned count, void*)
{
    for (unsigned i = 0; i < count; ++i)
        static_cast<BuildNode*>(node)->children[i] = static_cast<BuildNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*)
{
    for (unsigned i = 0; i < count; ++i)
        static_cast<BuildNode*>(node)->bounds[i] = *bounds[i];
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
    std::size_t count, void*)
{
    assert(count <= kBvhMaxLeaf);
    BuildNode* node = new_node(allocator);
    node->leaf = true;
    node->count = static_cast<unsigned>(count);
    for (std::size_t i = 0; i < count; ++i)
        node->primitives[i] = primitives[i].primID;
    // Embree's threads may deliver a leaf in any order; ours is one.
    std::sort(node->primitives.begin(), node->primitives.begin() + node->count);
    return node;
}

Tree build_tree(RTCDevice device, std::vector<RTCBuildPrimitive> primitives)
{
    Tree tree;
    if (primitives.empty())
        return tree;
    tree.bounds = {primitives[0].lower_x, primitives[0].lower_y, primitives[0].lower_z, 0,
        primitives[0].upper_x, primitives[0].upper_y, primitives[0].upper_z, 0};
    for (const RTCBuildPrimitive& p : primitives) {
        RTCBounds& b = tree.bounds;
        b.lower_x = std::min(b.lower_x, p.lower_x), b.upper_x = std::max(b.upper_x, p.upper_x);
        b.lower_y = std::min(b.lower_y, p.lower_y), b.upper_y = std::max(b.upper_y, p.upper_y);
        b.lower_z = std::min(b.lower_z, p.lower_z), b.upper_z = std::max(b.upper_z, p.upper_z);
    }
    tree.arena = rtcNewBVH(device);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.maxBranchingFactor = kBvhWidth;
    arguments.maxLeafSize = kBvhMaxLeaf;
    arguments.maxDepth = 64;
    arguments.bvh = tree.arena;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    tree.root = static_cast<BuildNode*>(rtcBuildBVH(&arguments));
    if (tree.root == nullptr)
        throw std::runtime_error("Embree could not build the bounding volume hierarchy");
    return tree;
}

PrimitiveBounds packed(const RTCBounds& b)
{
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

/// Writes nodes depth first.
class Packer {
public:
    explicit Packer(Bvh& bvh) : bvh_(bvh) { }

    unsigned pack(const BuildNode& node)
    {
        if (node.leaf) {
            const auto first = static_cast<unsigned>(bvh_.order.size()) - first_of_kind_;
            bvh_.order.insert(
                bvh_.order.end(), node.primitives.begin(), node.primitives.begin() + node.count);
            return BVH_LEAF_BIT | kind_ | ((node.count - 1) << BVH_COUNT_SHIFT) | first;
        }
        std::array<const BuildNode*, kBvhWidth> children{};
        std::copy(node.children.begin(), node.children.begin() + node.count, children.begin());
        return pack_children(children, node.bounds);
    }

    unsigned pack_children(const std::array<const BuildNode*, kBvhWidth>& children,
        const std::array<RTCBounds, kBvhWidth>& bounds)
    {
        const auto at = static_cast<unsigned>(bvh_.nodes.size());
        bvh_.nodes.resize(at + BVH_NODE_TEXELS);
        for (std::size_t i = 0; i < kBvhWidth; ++i) {
            const bool there = children[i] != nullptr;
            set_child_bounds(bvh_.nodes, at, i, there ? packed(bounds[i]) : kNowhereBounds);
            const unsigned word = there ? pack(*children[i]) : BVH_NO_CHILD;
            bvh_.nodes[at + 6][static_cast<int>(i)] = word;
        }
        return at;
    }

    void begin_kind(PrimitiveKind kind)
    {
        kind_ = kLeafKind[static_cast<std::size_t>(kind)];
        first_of_kind_ = static_cast<unsigned>(bvh_.order.size());
    }

private:
    Bvh& bvh_;
    unsigned kind_ = BVH_TRIANGLES;
    unsigned first_of_kind_ = 0;
};

/// Most stack entries below a packed node: all children but one wait while the deepest is visited.
int stack_need(const Bvh& bvh, unsigned at)
{
    int children = 0;
    int deepest = 0;
    for (int i = 0; i < kBvhWidth; ++i) {
        const unsigned word = bvh.nodes[at + 6][i];
        if (word == BVH_NO_CHILD)
            continue;
        ++children;
        if ((word & BVH_LEAF_BIT) == 0)
            deepest = std::max(deepest, stack_need(bvh, word));
    }
    return std::max(children - 1, 0) + deepest;
}

RTCBuildPrimitive embree_primitive(const PrimitiveBounds& bounds, std::size_t index)
{
    for (int axis = 0; axis < 3; ++axis)
        if (!(bounds.lower[axis] <= bounds.upper[axis] && std::abs(bounds.lower[axis]) < 1e30F
                && std::abs(bounds.upper[axis]) < 1e30F))
            throw std::invalid_argument("primitive " + std::to_string(index)
                + ": bounds are not finite and below 1e30, so no tree can hold it");
    RTCBuildPrimitive primitive{};
    primitive.lower_x = bounds.lower.x, primitive.lower_y = bounds.lower.y,
    primitive.lower_z = bounds.lower.z;
    primitive.upper_x = bounds.upper.x, primitive.upper_y = bounds.upper.y,
    primitive.upper_z = bounds.upper.z;
    primitive.primID = static_cast<unsigned>(index);
    return primitive;
}

/// The root's children are the trees of the kinds; an inner tree that is alone is its own root.
void pack_trees(Bvh& bvh, const std::array<Tree, kPrimitiveKinds>& trees)
{
    Packer packer(bvh);
    const auto there = [](const Tree& tree) { return tree.root != nullptr; };
    const auto first = std::find_if(trees.begin(), trees.end(), there);
    if (std::count_if(trees.begin(), trees.end(), there) == 1 && !first->root->leaf) {
        packer.begin_kind(static_cast<PrimitiveKind>(first - trees.begin()));
        packer.pack(*first->root);
        return;
    }
    packer.pack_children({}, {});
    for (std::size_t kind = 0; kind < kPrimitiveKinds; ++kind) {
        if (trees[kind].root == nullptr)
            continue;
        packer.begin_kind(static_cast<PrimitiveKind>(kind));
        const unsigned word = packer.pack(*trees[kind].root);  // may move bvh.nodes
        bvh.nodes[6][static_cast<int>(kind)] = word;
        set_child_bounds(bvh.nodes, 0, kind, packed(trees[kind].bounds));
    }
}

}  // namespace

Bvh build_bvh(std::span<const PrimitiveBounds> bounds, std::span<const PrimitiveKind> kind_of)
{
    assert(bounds.size() == kind_of.size());
    std::array<std::vector<RTCBuildPrimitive>, kPrimitiveKinds> primitives;
    for (std::size_t i = 0; i < bounds.size(); ++i)
        primitives[static_cast<std::size_t>(kind_of[i])].push_back(embree_primitive(bounds[i], i));

    const Device embree;
    std::array<Tree, kPrimitiveKinds> trees;
    for (std::size_t kind = 0; kind < trees.size(); ++kind)
        trees[kind] = build_tree(embree.device, std::move(primitives[kind]));
    Bvh bvh;
    pack_trees(bvh, trees);
    for (const Tree& tree : trees)
        if (tree.arena != nullptr)
            rtcReleaseBVH(tree.arena);
    bvh.stack_depth = stack_need(bvh, 0);
    return bvh;
}

void set_child_bounds(
    std::span<glm::uvec4> nodes, std::size_t at, std::size_t child, const PrimitiveBounds& bounds)
{
    for (int axis = 0; axis < 3; ++axis) {
        const auto row = at + static_cast<std::size_t>(axis);
        nodes[row][static_cast<int>(child)] = std::bit_cast<unsigned>(bounds.lower[axis]);
        nodes[row + 3][static_cast<int>(child)] = std::bit_cast<unsigned>(bounds.upper[axis]);
    }
}

PrimitiveBounds child_bounds(std::span<const glm::uvec4> nodes, std::size_t at, std::size_t child)
{
    PrimitiveBounds bounds{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto row = at + static_cast<std::size_t>(axis);
        bounds.lower[axis] = std::bit_cast<float>(nodes[row][static_cast<int>(child)]);
        bounds.upper[axis] = std::bit_cast<float>(nodes[row + 3][static_cast<int>(child)]);
    }
    return bounds;
}

PrimitiveBounds root_bounds(std::span<const glm::uvec4> nodes, std::size_t at)
{
    PrimitiveBounds bounds = kNowhereBounds;
    bool first = true;
    for (std::size_t i = 0; i < kBvhWidth; ++i) {
        if (nodes[at + 6][static_cast<int>(i)] == BVH_NO_CHILD)
            continue;
        const PrimitiveBounds child = child_bounds(nodes, at, i);
        bounds.lower = first ? child.lower : glm::min(bounds.lower, child.lower);
        bounds.upper = first ? child.upper : glm::max(bounds.upper, child.upper);
        first = false;
    }
    return bounds;
}

void relocate(std::span<glm::uvec4> nodes, std::uint32_t node,
    const std::array<std::uint32_t, kPrimitiveKinds>& first)
{
    for (std::size_t at = 6; at < nodes.size(); at += BVH_NODE_TEXELS)
        for (int i = 0; i < kBvhWidth; ++i) {
            std::uint32_t& word = nodes[at][i];
            const auto kind = (word & BVH_KIND_MASK) / BVH_SPHERES;
            if (word != BVH_NO_CHILD)
                word += (word & BVH_LEAF_BIT) != 0 ? first[kind] : node;
        }
}

void refit(std::span<glm::uvec4> nodes, std::size_t first, std::size_t root, std::size_t end,
    const std::function<PrimitiveBounds(std::uint32_t)>& leaf_bounds)
{
    for (std::size_t at = end - first; at > root - first;) {
        at -= BVH_NODE_TEXELS;
        for (std::size_t i = 0; i < kBvhWidth; ++i) {
            const std::uint32_t word = nodes[at + 6][static_cast<int>(i)];
            if (word != BVH_NO_CHILD)
                set_child_bounds(nodes, at, i,
                    (word & BVH_LEAF_BIT) != 0 ? leaf_bounds(word)
                                               : root_bounds(nodes, word - first));
        }
    }
}

}  // namespace farlight
