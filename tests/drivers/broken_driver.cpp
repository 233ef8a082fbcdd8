// An OpenCL driver that fails as the environment variable BROKEN_DRIVER says: "crash on load" and
// "hang on load" at once, "crash when asked" and "hang when asked" once a device's properties are
// queried. Otherwise it has one platform with one device of which nothing can be known.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl_icd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

struct _cl_platform_id {
    cl_icd_dispatch* dispatch;
};
struct _cl_device_id {
    cl_icd_dispatch* dispatch;
};

namespace {

cl_icd_dispatch dispatch;
_cl_platform_id platform{&dispatch};
_cl_device_id device{&dispatch};

void fail(const std::string& when) {
    const char* failure = std::getenv("BROKEN_DRIVER");
    if (failure == nullptr) return;
    if (failure == "crash " + when) std::abort();
    if (failure == "hang " + when) sleep(1000);
}

cl_int CL_API_CALL
platform_info(cl_platform_id, cl_platform_info name, size_t size, void* value, size_t* needed) {
    std::string text = "broken";
    if (name == CL_PLATFORM_VERSION) text = "OpenCL 1.2 broken";
    if (name == CL_PLATFORM_EXTENSIONS) text = "cl_khr_icd";
    if (needed != nullptr) *needed = text.size() + 1;
    if (value != nullptr) std::memcpy(value, text.c_str(), std::min(size, text.size() + 1));
    return CL_SUCCESS;
}

cl_int CL_API_CALL
device_ids(cl_platform_id, cl_device_type, cl_uint room, cl_device_id* devices, cl_uint* count) {
    if (count != nullptr) *count = 1;
    if (devices != nullptr && room > 0) devices[0] = &device;
    return CL_SUCCESS;
}

// Answers the one question that opencl.hpp asks without looking at the error.
cl_int CL_API_CALL
device_info(cl_device_id, cl_device_info name, size_t size, void* value, size_t*) {
    if (name != CL_DEVICE_PLATFORM || size != sizeof(cl_platform_id)) {
        fail("when asked");
        return CL_INVALID_DEVICE;
    }
    const cl_platform_id id = &platform;
    std::memcpy(value, &id, sizeof(cl_platform_id));
    return CL_SUCCESS;
}

cl_int CL_API_CALL keep_device(cl_device_id) {
    return CL_SUCCESS;
}

cl_int CL_API_CALL platform_ids(cl_uint room, cl_platform_id* platforms, cl_uint* count) {
    if (count != nullptr) *count = 1;
    if (platforms != nullptr && room > 0) platforms[0] = &platform;
    return CL_SUCCESS;
}

[[gnu::constructor]] void load() {
    fail("on load");
    dispatch.clGetPlatformInfo = platform_info;
    dispatch.clGetDeviceIDs = device_ids;
    dispatch.clGetDeviceInfo = device_info;
    dispatch.clRetainDevice = keep_device;
    dispatch.clReleaseDevice = keep_device;
}

}  // namespace

// The two functions by which a loader takes in a driver (the extension cl_khr_icd).
extern "C" {
CL_API_ENTRY cl_int CL_API_CALL
clIcdGetPlatformIDsKHR(cl_uint room, cl_platform_id* platforms, cl_uint* count) {
    return platform_ids(room, platforms, count);
}

CL_API_ENTRY void* CL_API_CALL clGetExtensionFunctionAddress(const char* name) {
    if (std::string(name) == "clIcdGetPlatformIDsKHR")
        return reinterpret_cast<void*>(&clIcdGetPlatformIDsKHR);
    return nullptr;
}

CL_API_ENTRY cl_int CL_API_CALL clGetPlatformInfo(
    cl_platform_id id, cl_platform_info name, size_t size, void* value, size_t* needed) {
    return platform_info(id, name, size, value, needed);
}
}
