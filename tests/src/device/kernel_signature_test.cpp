#include "device/kernel_signature.h"

#include "error.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;

auto is(const char* type, const char* name, bool is_buffer, bool is_written) {
    return AllOf(
        Field(&KernelParameter::type, type), Field(&KernelParameter::name, name),
        Field(&KernelParameter::is_buffer, is_buffer),
        Field(&KernelParameter::is_written, is_written));
}

TEST(KernelSignature, TellsBuffersFromNumbersAndWhatIsWritten) {
    const std::string source =
        "kernel void other(global int* x) {}\n"
        "kernel void one(\n    constant const Settings* restrict settings,\n    const uint slots,\n"
        "    global const float *restrict rays,\n    global Row* rows) {}\n";
    EXPECT_THAT(
        kernel_signature(source, "one"),
        ElementsAre(
            is("Settings", "settings", true, false), is("uint", "slots", false, false),
            is("float", "rays", true, false), is("Row", "rows", true, true)));
}

TEST(KernelSignature, ReadsMacrosOfSeveralLines) {
    const std::string source =
        "#define PAGES \\\n    global const Row *restrict rows, global const uint *restrict "
        "page_0, \\\n"
        "        global const uint *restrict page_1\n#define NEXT 1\n"
        "kernel void one(const uint slots, PAGES, global float* hits) {}\n";
    EXPECT_THAT(
        kernel_signature(source, "one"),
        ElementsAre(
            is("uint", "slots", false, false), is("Row", "rows", true, false),
            is("uint", "page_0", true, false), is("uint", "page_1", true, false),
            is("float", "hits", true, true)));
}

TEST(KernelSignature, NamesTheKernelThatIsMissingOrUnreadable) {
    EXPECT_THAT(
        [] { kernel_signature("kernel void ones(global int* x) {}", "one"); },
        testing::ThrowsMessage<Error>("kernel one: not in the program"));
    EXPECT_THAT(
        [] { kernel_signature("kernel void one(MACRO, global int* x) {}", "one"); },
        testing::ThrowsMessage<Error>("kernel one: no parameter: MACRO"));
}

}  // namespace
}  // namespace wavepath
