#include "prepare/bvh_builder.h"

#include "error.h"
#include "prepare/embree.h"
#include "prepare/triangle_split.h"
#include "stopwatch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <new>

namespace wavepath {
namespace {

constexpr unsigned branching = 8;
constexpr unsigned block_size = 8;
constexpr std::size_t small_scene = 8192;  // triangles

// Spatial splits take ten times as long to build. Where a first tree's siblings overlap by less
// than this part of their area they gained under 1 % in box tests (height field .26, spheres .39),
// above it 14 to 35 % (boxes through one another .54, rods 1.7).
constexpr double worthwhile_overlap = 0.45;

// Embree's depth limit: 26 is never met by a sane scene, 13 bounds the stack by 7 * 13 + 1 entries.
constexpr std::array<unsigned, 2> depth_limits{26, 13};
static_assert(7 * depth_limits.back() + 1 <= BVH_STACK);

// Embree's builder hands out nodes and leaves from its own arena; this tree is flattened and
// dropped.
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

void* create_node(RTCThreadLocalAllocator allocator, unsigned child_count, void* /*positions*/) {
    auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(InnerNode), 16)) InnerNode;
    node->child_count = child_count;
    return static_cast<BuildNode*>(node);
}

void set_children(void* node, void** children, unsigned child_count, void* /*positions*/) {
    auto& inner = *static_cast<InnerNode*>(static_cast<BuildNode*>(node));
    for (unsigned i = 0; i < child_count; ++i)
        inner.children[i] = static_cast<BuildNode*>(children[i]);
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

TriangleBlock make_block(const LeafNode& leaf, const std::vector<float>& positions) {
    TriangleBlock block{};  // all corners equal: the triangle test rejects such a lane
    std::fill(std::begin(block.primitives), std::end(block.primitives), BVH_EMPTY);
    for (unsigned lane = 0; lane < leaf.count; ++lane) {
        block.primitives[lane] = leaf.primitives[lane];
        const float* p = &positions[9 * std::size_t{leaf.primitives[lane]}];
        for (auto& vertex : block.vertices)
            for (auto& axis : vertex) axis[lane] = *p++;
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

// The kernels allow for what rounding of coordinates up to 0.5 moves; boxes outside the unit cube
// are wider by what it moves their own.
void set_box(BvhNode& node, unsigned child, const RTCBounds& box) {
    const std::array<float, 3> low{box.lower_x, box.lower_y, box.lower_z};
    const std::array<float, 3> high{box.upper_x, box.upper_y, box.upper_z};
    float away = 0.5F;
    for (std::size_t axis = 0; axis < 3; ++axis)
        away = std::max({away, std::abs(low[axis]), std::abs(high[axis])});
    const float margin = 0x1p-20F * (away - 0.5F);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.bounds[axis][0][child] = low[axis] - margin;
        node.bounds[axis][1][child] = high[axis] + margin;
    }
}

// Half the area of what children i and j of a node have in common.
double common_area(const BvhNode& node, unsigned i, unsigned j) {
    std::array<double, 3> edge{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& [low, high] = node.bounds[axis];
        edge[axis] = static_cast<double>(std::min(high[i], high[j]) - std::max(low[i], low[j]));
        if (!(edge[axis] >= 0)) return 0;
    }
    return edge[0] * edge[1] + edge[1] * edge[2] + edge[2] * edge[0];
}

// Lays the tree out depth first: a node's first inner child follows it in memory.
class Flattener {
  public:
    Flattener(const std::vector<float>& positions, Bvh& bvh) : positions_(positions), bvh_(bvh) {}

    // Returns the child word; `stack` becomes the entries that traversal below may need.
    shared_uint place(const BuildNode& node, unsigned& stack) {
        if (node.child_count == 0) return place_leaf(static_cast<const LeafNode&>(node), stack);
        const auto& inner = static_cast<const InnerNode&>(node);
        const std::size_t index = bvh_.nodes.size();
        bvh_.nodes.push_back(empty_node());
        unsigned deepest = 0;
        for (unsigned i = 0; i < inner.child_count; ++i) {
            unsigned below = 0;
            const shared_uint child = place(*inner.children[i], below);
            BvhNode& placed = bvh_.nodes[index];
            placed.children[i] = child;
            set_box(placed, i, inner.bounds[i]);
            deepest = std::max(deepest, below);
            area_ += common_area(placed, i, i);
            for (unsigned j = 0; j < i; ++j) overlap_ += common_area(placed, i, j);
        }
        // All children wait at first; then one is entered while the others wait.
        stack = std::max(inner.child_count, inner.child_count - 1 + deepest);
        return static_cast<shared_uint>(index);
    }

    // What siblings have in common, relative to their area.
    double overlap() const { return area_ > 0 ? overlap_ / area_ : 0; }

  private:
    shared_uint place_leaf(const LeafNode& leaf, unsigned& stack) {
        stack = 0;
        bvh_.blocks.push_back(make_block(leaf, positions_));
        return BVH_LEAF | static_cast<shared_uint>(bvh_.blocks.size() - 1);
    }

    const std::vector<float>& positions_;
    Bvh& bvh_;
    double area_ = 0;
    double overlap_ = 0;
};

std::vector<RTCBuildPrimitive> build_primitives(const std::vector<float>& positions) {
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(positions.size() / 9);
    for (std::size_t i = 0; i < positions.size() / 9; ++i) {
        if (!has_area(positions, i)) continue;
        const RTCBounds box = triangle_bounds(positions, i);
        primitives.push_back(
            {box.lower_x, box.lower_y, box.lower_z, 0, box.upper_x, box.upper_y, box.upper_z,
             static_cast<unsigned>(i)});
    }
    return primitives;
}

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

// A leaf as the whole tree becomes a node with one child: the kernels start at a node.
unsigned flatten(const BuildNode& root, const RTCBounds& box, Flattener& flattener, Bvh& bvh) {
    unsigned stack = 1;
    if (root.child_count > 0) {
        flattener.place(root, stack);
        return stack;
    }
    bvh.nodes.push_back(empty_node());
    unsigned below = 0;
    bvh.nodes[0].children[0] = flattener.place(root, below);
    set_box(bvh.nodes[0], 0, box);
    return stack;
}

RTCBounds bounds_of(const std::vector<RTCBuildPrimitive>& primitives) {
    RTCBounds box{};
    box.lower_x = box.lower_y = box.lower_z = std::numeric_limits<float>::infinity();
    box.upper_x = box.upper_y = box.upper_z = -std::numeric_limits<float>::infinity();
    for (const RTCBuildPrimitive& p : primitives) {
        box.lower_x = std::min(box.lower_x, p.lower_x);
        box.lower_y = std::min(box.lower_y, p.lower_y);
        box.lower_z = std::min(box.lower_z, p.lower_z);
        box.upper_x = std::max(box.upper_x, p.upper_x);
        box.upper_y = std::max(box.upper_y, p.upper_y);
        box.upper_z = std::max(box.upper_z, p.upper_z);
    }
    return box;
}

struct Attempt {
    Bvh bvh;
    double overlap = 0;
    unsigned stack = 0;
};

Attempt attempt(
    RTCDevice device, const std::vector<float>& positions, bool spatial_splits, unsigned depth) {
    Attempt result;
    std::vector<RTCBuildPrimitive> primitives = build_primitives(positions);
    const std::size_t count = primitives.size();
    if (count == 0) {
        result.bvh.nodes.push_back(empty_node());
        return result;
    }
    const RTCBounds box = bounds_of(primitives);
    if (spatial_splits) primitives.resize(count + count / 2);
    const std::unique_ptr<RTCBVHTy, Release> bvh(rtcNewBVH(device));
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = spatial_splits ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = branching;
    arguments.maxDepth = depth;
    // Full blocks are half the memory and as many steps; a tree that the caches hold anyway gains
    // by tighter ones, most of all where few triangles span the scene (docs/design/intersect.md).
    const bool is_small = count <= small_scene;
    arguments.sahBlockSize = is_small ? block_size / 2 : block_size;
    arguments.minLeafSize = is_small ? block_size / 4 : block_size;
    arguments.maxLeafSize = block_size;
    arguments.bvh = bvh.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = count;
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.splitPrimitive = split_triangle;
    arguments.userPtr = const_cast<std::vector<float>*>(&positions);
    const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
    if (root == nullptr)
        throw Error(
            "Embree: building over {} triangles failed (error {}); is there enough memory?", count,
            static_cast<int>(rtcGetDeviceError(device)));
    Flattener flattener(positions, result.bvh);
    result.stack = flatten(*root, box, flattener, result.bvh);
    result.overlap = flattener.overlap();
    return result;
}

}  // namespace

Bvh build_bvh(const std::vector<float>& positions) {
    Stopwatch watch;
    const std::unique_ptr<RTCDeviceTy, Release> device(rtcNewDevice(nullptr));
    if (!device) {
        const RTCError error = rtcGetDeviceError(nullptr);
        if (error == RTC_ERROR_OUT_OF_MEMORY)
            throw Error("Embree: no memory to start in; close other programs or raise `ulimit -v`");
        throw Error(
            "Embree: no device (error {}); check its installation and `ulimit -v`",
            static_cast<int>(error));
    }
    Attempt best = attempt(device.get(), positions, false, depth_limits.front());
    if (best.overlap > worthwhile_overlap)
        best = attempt(device.get(), positions, true, depth_limits.front());
    if (best.stack > BVH_STACK) best = attempt(device.get(), positions, false, depth_limits.back());
    best.bvh.build_seconds = watch.lap();
    return std::move(best.bvh);
}

void mark_holes(Bvh& bvh, const std::vector<bool>& holes) {
    for (TriangleBlock& block : bvh.blocks)
        for (shared_uint& primitive : block.primitives)
            if (primitive != BVH_EMPTY && holes[primitive]) primitive |= BVH_HOLES;
}

}  // namespace wavepath
