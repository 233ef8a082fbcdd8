#include "device/program.h"
#include "build_paths.h"

#include "device/embedded_kernels.h"
#include "error.h"
#include "support/environment_variable.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace wavepath {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// A folder of kernel files in place of the embedded ones.
struct KernelFolder {
    TemporaryFolder folder;
    EnvironmentVariable variable{"WAVEPATH_KERNELS", folder.path().string()};

    std::string path(const std::string& name) const { return (folder / name).string(); }
};

template <typename Function>
std::string message(const Function& function) {
    try {
        function();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(EmbeddedKernels, AreTheFilesByteForByte) {
    const EnvironmentVariable variable("WAVEPATH_KERNELS");
    std::set<std::string> names;
    for (const EmbeddedChunk& chunk : embedded_chunks()) names.insert(std::string(chunk.file));
    EXPECT_GT(names.size(), 10U);
    for (const std::string& name : names) {
        std::ifstream file(WAVEPATH_SOURCE_DIR "/kernels/" + name, std::ios::binary);
        const std::string text(std::istreambuf_iterator<char>(file), {});
        EXPECT_TRUE(kernel_file(name) == text) << name;
    }
}

TEST(KernelFile, ErrorsSayWhere) {
    {
        const EnvironmentVariable variable("WAVEPATH_KERNELS");
        EXPECT_THAT(message([] { kernel_file("no.cl"); }), StartsWith("kernels/no.cl: "));
    }
    const KernelFolder kernels;
    EXPECT_THAT(message([] { kernel_file("no.cl"); }), StartsWith(kernels.path("no.cl: ")));
    const EnvironmentVariable variable("WAVEPATH_KERNELS", "/no/such/folder");
    EXPECT_THAT(
        message([] { kernel_file("a.cl"); }), StartsWith("WAVEPATH_KERNELS=/no/such/folder: "));
}

TEST(AssembleSource, PutsEachFileInOnceWithItsLineNumbers) {
    const KernelFolder kernels;
    kernels.folder.write(
        "a.cl", "#pragma once\n#include \"b.h\"\nint a;\n  # include \"c.h\" // again\nint aa;");
    kernels.folder.write("b.h", "#include \"c.h\"\nint b;\n");
    kernels.folder.write("c.h", "int c;\n");
    const std::string a = "\"" + kernels.path("a.cl") + "\"\n",
                      b = "\"" + kernels.path("b.h") + "\"\n",
                      c = "\"" + kernels.path("c.h") + "\"\n";
    EXPECT_EQ(
        assemble_source("#define X 1", {"a.cl", "c.h"}),
        "#pragma OPENCL FP_CONTRACT OFF\n#define X 1\n"
        "#line 1 " +
            a +
            "\n"
            "#line 1 " +
            b + "#line 1 " + c +
            "int c;\n"
            "#line 2 " +
            b +
            "int b;\n"
            "#line 3 " +
            a +
            "int a;\n"
            "#line 5 " +
            a + "int aa;\n");
}

TEST(AssembleSource, LeavesWhatOnlyTheHostIncludes) {
    const KernelFolder kernels;
    const std::string text =
        "#ifdef __cplusplus\n#if 1\n#include \"host.h\"\n#endif\n#include \"more_host.h\"\n#else\n"
        "int device;\n#endif\n";
    kernels.folder.write("a.h", text);
    EXPECT_THAT(assemble_source("", {"a.h"}), HasSubstr(text));

    kernels.folder.write("a.h", "#ifdef __cplusplus\n#else\n#include \"no.h\"\n#endif\n");
    EXPECT_THAT(
        message([] { assemble_source("", {"a.h"}); }), HasSubstr("a.h:3: #include \"no.h\""));
}

TEST(AssembleSource, AMissingIncludeNamesIncluderAndLine) {
    const KernelFolder kernels;
    kernels.folder.write("a.cl", "int a;\n\n#include \"no.h\"\n");
    EXPECT_THAT(
        message([] { assemble_source("", {"a.cl"}); }),
        StartsWith(kernels.path("a.cl:3: #include \"no.h\"")));
}

TEST(BuildProgram, AnErrorNamesTheFileAndLineAndHoldsTheLog) {
    const KernelFolder kernels;
    kernels.folder.write("a.cl", "#include \"b.h\"\nkernel void a(global int* x) { *x = b(); }\n");
    kernels.folder.write("b.h", "int b(void);\nint b(void) {\n    return undeclared;\n}\n");
    const Device device = open_device("");
    const std::string source = assemble_source("", {"a.cl"});
    const std::string text = message([&] { build_program(device, source); });
    EXPECT_THAT(
        text, StartsWith(kernels.path("b.h:3:12: use of undeclared identifier 'undeclared' (")));
    EXPECT_THAT(text, HasSubstr(device.info.name + "); mend the folder"));
    EXPECT_THAT(text.substr(text.find('\n')), HasSubstr("undeclared"));
}

TEST(BuildProgram, ReportsTimeAndLog) {
    const Device device = open_device("");
    BuildReport report;
    build_program(
        device, "#warning said by the compiler\nkernel void a(global int* x) { *x = 1; }\n",
        &report);
    EXPECT_GT(report.seconds, 0);
    EXPECT_FALSE(report.from_cache);  // PoCL keeps its own
    EXPECT_THAT(report.log, HasSubstr("said by the compiler"));
}

// Bit equality between devices rests on it: a * b + c is two roundings.
TEST(BuildProgram, DoesNotContract) {
    const KernelFolder kernels;
    kernels.folder.write("a.cl", "kernel void a(global float* x) { x[0] = x[1] * x[2] + x[3]; }\n");
    const Device device = open_device("");
    cl::Kernel kernel(build_program(device, assemble_source("", {"a.cl"})), "a");
    float x[4] = {
        0, 1 + 0x1p-12F, 1 + 0x1p-12F, -1 - 0x1p-11F};  // the product's last bit is lost, or not
    const cl::Buffer buffer(device.context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, sizeof(x), x);
    kernel.setArg(0, buffer);
    device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
    device.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, sizeof(x), x);
    EXPECT_EQ(x[0], 0.0F);
}

}  // namespace
}  // namespace wavepath
