#include "device/huge_pages.h"

#include "support/probe.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace wavepath {
namespace {

// Whether the system gives huge pages is its own affair; the buffer is as good as any.
TEST(HugePages, BuffersKeepTheirContents) {
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{1000}, (std::size_t{5} << 20U) + 3}) {
        std::vector<cl_uint> values(count);
        std::iota(values.begin(), values.end(), 1U);
        const DeviceArray<cl_uint> array(test_device(), values, "values");
        EXPECT_EQ(array.read(test_device()), values) << count;
    }
}

}  // namespace
}  // namespace wavepath
