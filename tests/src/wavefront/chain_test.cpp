// The chain without a device: every stage finds its buffers, every feature its kernels.
#include "wavefront/chain.h"

#include "device/program.h"
#include "wavefront/path_pool.h"
#include "wavefront/queue_manager.h"
#include "wavefront/scene_buffers.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include "build_paths.h"

namespace wavepath {
namespace {

// All that decides whether there is a stage, but for what needs the other of two ways to connect.
Features all_features() {
    Features f;
    f.contacts = f.media = f.textures = f.partial_boundaries = true;
    f.environment = f.area_lights = f.sample_lights = f.smooth_walls = true;
    f.dielectrics = f.media_scatter = true;
    f.split_levels = 1;
    return f;
}

Features without_passages(Features f) {
    f.media = f.smooth_walls = f.lamps_on_lamps = false;
    return f;
}

std::vector<std::string> stages_of(const Features& features) {
    std::vector<std::string> stages;
    visit_stages(
        features, [&](const char* stage, Shape = Shape::slots) { stages.emplace_back(stage); });
    return stages;
}

TEST(Chain, VisitsEveryKernelFile) {
    std::set<std::string> visited;
    for (const Features& features : {all_features(), without_passages(all_features())})
        for (const std::string& stage : stages_of(features)) visited.insert(stage);
    std::set<std::string> files;
    const std::filesystem::path folder{WAVEPATH_SOURCE_DIR "/kernels/stages"};
    for (const auto& file : std::filesystem::directory_iterator(folder))
        files.insert(file.path().stem());
    for (const std::string& file : files)
        EXPECT_TRUE(visited.contains(file))
            << "kernels/stages/" << file << ".cl: no stage in src/wavefront/chain.h, or one behind "
            << "a feature that all_features() above does not set";
    for (const std::string& stage : visited)
        EXPECT_TRUE(files.contains(stage)) << "no file kernels/stages/" << stage << ".cl";
}

TEST(Chain, EveryStageFindsItsBuffers) {
    const KernelBuffers buffers = name_buffers({}, {}, {});
    for (const Features& features : {all_features(), without_passages(all_features())}) {
        const std::string source = QueueManager::source_of(features);
        for (const std::string& stage : stages_of(features))
            for (const KernelParameter& parameter : kernel_signature(source, stage))
                if (parameter.is_buffer) {
                    EXPECT_NO_THROW(buffers.of(stage, parameter));
                }
    }
}

// The kernel of whole paths calls the chain's stages in its order, each once, and nothing that
// counts for the host.
TEST(Chain, AMegakernelHoldsTheStages) {
    Features features = all_features();
    features.megakernel = true;
    const std::string source = QueueManager::source_of(features);
    const std::string text = source.substr(source.find("kernel void megakernel("));
    std::vector<std::string> called;
    const std::regex call("\n {8}(\\w+)\\(settings");
    for (std::sregex_iterator i(text.begin(), text.end(), call), end; i != end; ++i)
        called.push_back((*i)[1]);
    std::vector<std::string> stages = stages_of(features);
    for (const char* other :
         {"assign_units", "scatter_queue", "move_paths", "scan_queue", "fold_film"})
        std::erase(stages, other);
    EXPECT_EQ(called, stages);
    const KernelBuffers buffers = name_buffers({}, {}, {});
    for (const KernelParameter& parameter : kernel_signature(source, "megakernel"))
        if (parameter.is_buffer) {
            EXPECT_NO_THROW(buffers.of("megakernel", parameter));
        }
}

TEST(Chain, UnknownNamesWrongTypesAndWritesAreRefusedByName) {
    KernelBuffers buffers;
    buffers.add("rays", DeviceArray<cl_float>{}, Access::write);
    buffers.add("lights", DeviceArray<DeviceLight>{}, Access::read);
    const auto bind = [&](const std::string& parameters) {
        const std::string source = "kernel void one(" + parameters + ") {}";
        return [&buffers, source] { buffers.of("one", kernel_signature(source, "one").front()); };
    };
    EXPECT_NO_THROW(bind("global const float* rays")());
    EXPECT_THAT(
        bind("global const float* ray"),
        testing::ThrowsMessage<Error>("kernel one: parameter ray: no buffer of this name"));
    EXPECT_THAT(
        bind("global const uint* rays"),
        testing::ThrowsMessage<Error>(
            "kernel one: parameter rays is of uint, its buffer of float"));
    EXPECT_THAT(
        bind("global DeviceLight* lights"),
        testing::ThrowsMessage<Error>(
            "kernel one: parameter lights has to be const: kernels only read it"));
}

// A define that no kernel knows would leave the kernels' own default standing, mostly 1.
TEST(Chain, EveryDefineIsAskedForAndEveryFeatureDefined) {
    const auto names = [](const std::string& text, const std::regex& pattern) {
        std::set<std::string> found;
        for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i)
            found.insert((*i)[1]);
        return found;
    };
    const std::regex question("#ifndef (\\w+)");
    const std::set<std::string> given = names(Features{}.defines(), std::regex("#define (\\w+) "));
    const std::set<std::string> asked = names(QueueManager::source_of(all_features()), question);
    EXPECT_THAT(given, testing::Each(testing::AnyOfArray(asked)));
    std::set<std::string> features = names(kernel_file("shared/features.h"), question);
    features.erase("WAVEPATH_FEATURES_H");
    EXPECT_THAT(features, testing::Each(testing::AnyOfArray(given)));
}

}  // namespace
}  // namespace wavepath
