#include "scene/scene.h"

namespace wavepath {

std::size_t Scene::triangle_count() const {
    std::size_t count = 0;
    for (const Instance& instance : instances)
        count += primitives[instance.primitive].indices.size() / 3;
    return count;
}

}  // namespace wavepath
