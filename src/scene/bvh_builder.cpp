#include "scene/bvh_builder.h"

#include "error.h"
#include "scene/embree.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <new>

namespace wavepath {
namespace {

constexpr unsigned branching = 8;
constexpr unsigned block_size = 8;

// Embree's builder hands out nodes and leaves from its own arena; this tree is flattened and dropped.
struct BuildNode {
    unsigned child_count = 0;  // 0: a leaf
};

struct InnerNode : BuildNode {
    std::array<BuildNode*, branching> children{};
    std::array<RTCBounds, branching> bounds{};
};

struct LeafNode : BuildNode {
    unsigned count = 0;
    std::array<unsigned, block_size> primitives{};
};

using Vec3 = std::array<float, 3>;

Vec3 corner_of(const std::vector<float>& positions, std::size_t triangle, std::size_t corner) {
    const float* p = &positions[9 * triangle + 3 * corner];
    return {p[0], p[1], p[2]};
}

// Differences of neighbouring floats are exact in double, so only true slivers of no width are called flat.
bool has_area(const std::vector<float>& positions, std::size_t triangle) {
    const float* p = &positions[9 * triangle];
    std::array<double, 3> e{};
    std::array<double, 3> f{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        e[axis] = static_cast<double>(p[3 + axis]) - static_cast<double>(p[axis]);
        f[axis] = static_cast<double>(p[6 + axis]) - static_cast<double>(p[axis]);
    }
    return e[1] * f[2] != e[2] * f[1] || e[2] * f[0] != e[0] * f[2] || e[0] * f[1] != e[1] * f[0];
}

struct Box {
    Vec3 low{inf, inf, inf};
    Vec3 high{-inf, -inf, -inf};

    void add(const Vec3& point) { add(point, point); }
    void add(const Vec3& from, const Vec3& to) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], from[axis]);
            high[axis] = std::max(high[axis], to[axis]);
        }
    }

    RTCBounds clipped(const RTCBuildPrimitive& to) const {
        return {
            std::max(low[0], to.lower_x), std::max(low[1], to.lower_y), std::max(low[2], to.lower_z), 0,
            std::min(high[0], to.upper_x), std::min(high[1], to.upper_y), std::min(high[2], to.upper_z), 0};
    }

    static constexpr float inf = std::numeric_limits<float>::infinity();
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned child_count, void* /*positions*/) {
    auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(InnerNode), 16)) InnerNode;
    node->child_count = child_count;
    return static_cast<BuildNode*>(node);
}

void set_children(void* node, void** children, unsigned child_count, void* /*positions*/) {
    auto& inner = *static_cast<InnerNode*>(static_cast<BuildNode*>(node));
    for (unsigned i = 0; i < child_count; ++i) inner.children[i] = static_cast<BuildNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned child_count, void* /*positions*/) {
    auto& inner = *static_cast<InnerNode*>(static_cast<BuildNode*>(node));
    for (unsigned i = 0; i < child_count; ++i) inner.bounds[i] = *bounds[i];
}

void* create_leaf(
    RTCThreadLocalAllocator allocator,
    const RTCBuildPrimitive* primitives,
    std::size_t count,
    void* /*positions*/) {
    auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(LeafNode), 16)) LeafNode;
    leaf->count = static_cast<unsigned>(count);
    for (std::size_t i = 0; i < count; ++i) leaf->primitives[i] = primitives[i].primID;
    return static_cast<BuildNode*>(leaf);
}

// The part of a triangle on either side of an axis-aligned plane, for spatial splits [Stich 2009, section 4]. Where an
// edge crosses the plane its point is widened by 8 ulp of the edge's coordinates, more than its rounding.
void split_primitive(
    const RTCBuildPrimitive* primitive,
    unsigned dimension,
    float position,
    RTCBounds* left_bounds,
    RTCBounds* right_bounds,
    void* user) {
    const auto& positions = *static_cast<const std::vector<float>*>(user);
    Box left;
    Box right;
    Vec3 a = corner_of(positions, primitive->primID, 2);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 b = corner_of(positions, primitive->primID, i);
        if (b[dimension] <= position) left.add(b);
        if (b[dimension] >= position) right.add(b);
        if (std::min(a[dimension], b[dimension]) < position && position < std::max(a[dimension], b[dimension])) {
            const float s = (position - a[dimension]) / (b[dimension] - a[dimension]);
            Vec3 from{};
            Vec3 to{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float cut = a[axis] + s * (b[axis] - a[axis]);
                const float margin = 4.8e-7F * (std::abs(a[axis]) + std::abs(b[axis]));
                from[axis] = cut - margin;
                to[axis] = cut + margin;
            }
            left.add(from, to);
            right.add(from, to);
        }
        a = b;
    }
    *left_bounds = left.clipped(*primitive);
    *right_bounds = right.clipped(*primitive);
    (&left_bounds->upper_x)[dimension] = std::min((&left_bounds->upper_x)[dimension], position);
    (&right_bounds->lower_x)[dimension] = std::max((&right_bounds->lower_x)[dimension], position);
}

TriangleBlock make_block(const LeafNode& leaf, const std::vector<float>& positions) {
    TriangleBlock block{};  // all corners equal: the triangle test rejects such a lane
    for (unsigned lane = 0; lane < block_size; ++lane) {
        block.primitives[lane] = BVH_EMPTY;
        if (lane >= leaf.count) continue;
        block.primitives[lane] = leaf.primitives[lane];
        for (std::size_t vertex = 0; vertex < 3; ++vertex)
            for (std::size_t axis = 0; axis < 3; ++axis)
                block.vertices[vertex][axis][lane] = positions[9 * std::size_t{leaf.primitives[lane]} + 3 * vertex + axis];
    }
    return block;
}

BvhNode empty_node() {
    BvhNode node{};
    for (auto& axis : node.bounds) {
        std::fill(std::begin(axis[0]), std::end(axis[0]), std::numeric_limits<float>::infinity());
        std::fill(std::begin(axis[1]), std::end(axis[1]), -std::numeric_limits<float>::infinity());
    }
    std::fill(std::begin(node.children), std::end(node.children), BVH_EMPTY);
    return node;
}

void set_box(BvhNode& node, unsigned child, const RTCBounds& box) {
    const std::array<float, 3> low{box.lower_x, box.lower_y, box.lower_z};
    const std::array<float, 3> high{box.upper_x, box.upper_y, box.upper_z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.bounds[axis][0][child] = low[axis];
        node.bounds[axis][1][child] = high[axis];
    }
}

// Depth-first order: a node's first child follows it in memory.
class Flattener {
  public:
    Flattener(const std::vector<float>& positions, Bvh& bvh) : positions_(positions), bvh_(bvh) {}

    // Returns the child word; `stack` becomes the entries that traversal below this node may need.
    shared_uint place(const BuildNode& node, unsigned& stack) {
        if (node.child_count == 0) return place_leaf(static_cast<const LeafNode&>(node), stack);
        const auto& inner = static_cast<const InnerNode&>(node);
        const std::size_t index = bvh_.nodes.size();
        bvh_.nodes.push_back(empty_node());
        unsigned deepest = 0;
        for (unsigned i = 0; i < inner.child_count; ++i) {
            unsigned below = 0;
            const shared_uint child = place(*inner.children[i], below);
            bvh_.nodes[index].children[i] = child;
            set_box(bvh_.nodes[index], i, inner.bounds[i]);
            deepest = std::max(deepest, below);
        }
        stack = std::max(inner.child_count, inner.child_count - 1 + deepest);  // one child is entered, the others wait
        return static_cast<shared_uint>(index);
    }

  private:
    shared_uint place_leaf(const LeafNode& leaf, unsigned& stack) {
        stack = 0;
        const std::size_t block = bvh_.blocks.size();
        bvh_.blocks.push_back(make_block(leaf, positions_));
        return BVH_LEAF | static_cast<shared_uint>(block);
    }

    const std::vector<float>& positions_;
    Bvh& bvh_;
};

std::vector<RTCBuildPrimitive> build_primitives(const std::vector<float>& positions) {
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(positions.size() / 9 * 3 / 2);  // room for spatial splits
    for (std::size_t i = 0; i < positions.size() / 9; ++i) {
        if (!has_area(positions, i)) continue;  // no ray can hit it
        Box box;
        for (std::size_t corner = 0; corner < 3; ++corner) box.add(corner_of(positions, i, corner));
        primitives.push_back({box.low[0], box.low[1], box.low[2], 0, box.high[0], box.high[1], box.high[2], static_cast<unsigned>(i)});
    }
    return primitives;
}

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseBvh {
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

}  // namespace

Bvh build_bvh(const std::vector<float>& positions) {
    const auto start = std::chrono::steady_clock::now();
    Bvh result;
    std::vector<RTCBuildPrimitive> primitives = build_primitives(positions);
    const std::size_t count = primitives.size();
    if (count == 0) {
        result.nodes.push_back(empty_node());
        return result;
    }
    const std::unique_ptr<RTCDeviceTy, ReleaseDevice> device(rtcNewDevice(nullptr));
    if (!device) throw Error("Embree: no device (error {}); check its installation", static_cast<int>(rtcGetDeviceError(nullptr)));
    const std::unique_ptr<RTCBVHTy, ReleaseBvh> bvh(rtcNewBVH(device.get()));

    primitives.resize(primitives.capacity());
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_HIGH;
    arguments.maxBranchingFactor = branching;
    arguments.maxDepth = 26;
    arguments.sahBlockSize = block_size;
    arguments.minLeafSize = block_size;
    arguments.maxLeafSize = block_size;
    arguments.traversalCost = 1;
    arguments.intersectionCost = 1;
    arguments.bvh = bvh.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = count;
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.splitPrimitive = split_primitive;
    arguments.userPtr = const_cast<std::vector<float>*>(&positions);
    const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
    if (root == nullptr)
        throw Error("Embree: building over {} triangles failed (error {}); is there enough memory?", count, static_cast<int>(rtcGetDeviceError(device.get())));

    unsigned stack = 0;
    Flattener flattener(positions, result);
    if (root->child_count > 0) {
        flattener.place(*root, stack);
    } else {  // the device code starts at a node
        result.nodes.push_back(empty_node());
        result.nodes[0].children[0] = flattener.place(*root, stack);
        Box box;
        for (const float* p = positions.data(); p != positions.data() + positions.size(); p += 3) box.add({p[0], p[1], p[2]});
        set_box(result.nodes[0], 0, {box.low[0], box.low[1], box.low[2], 0, box.high[0], box.high[1], box.high[2], 0});
    }
    if (stack > BVH_STACK) throw Error("the scene's tree needs a stack of {} entries, the kernels have {}", stack, BVH_STACK);
    result.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace wavepath
