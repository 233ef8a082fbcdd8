#include "scene/gltf_unresolved.h"

#include <gtest/gtest.h>

namespace wavepath {
namespace {

TEST(UnresolvedAccessor, NamesTheFirstPrimitive) {
    const char* const good = R"({"primitives":[{"attributes":{"POSITION":0},"indices":1}]})";
    const auto found = [&](const std::string& mesh) {
        return unresolved_accessor(
            R"({"accessors":[{},{}],"meshes":[)" + std::string(good) + "," + mesh + "]}");
    };
    EXPECT_EQ(
        found(R"({"primitives":[{"attributes":{"POSITION":0}},{"attributes":{"NORMAL":2}}]})"),
        "mesh 1, primitive 1: NORMAL names accessor 2, there are 2");
    EXPECT_EQ(
        found(R"({"primitives":[{"attributes":{"POSITION":0},"indices":-1}]})"),
        "mesh 1, primitive 0: indices names accessor -1, there are 2");
    EXPECT_EQ(found(good), "");
}

TEST(UnresolvedAccessor, SurvivesWhatIsNoGltf) {
    for (const char* text :
         {"", "{", "[]", "7", R"({"meshes":7})", R"({"meshes":[7,{"primitives":[3,{}]}]})",
          R"({"meshes":[{"primitives":[{"attributes":[1],"indices":"x"}]}]})"})
        EXPECT_NO_THROW(unresolved_accessor(text)) << text;
}

}  // namespace
}  // namespace wavepath
