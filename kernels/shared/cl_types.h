// Types that C++ and OpenCL C read alike. Shared structs hold only these, fill a multiple of 16
// bytes, and are checked by SHARED_SIZE in both languages and field by field in
// tests/kernels/layout_test.cpp.
#ifndef WAVEPATH_CL_TYPES_H
#define WAVEPATH_CL_TYPES_H

#ifdef __cplusplus
#include <cstdint>
typedef float shared_float;
typedef std::int32_t shared_int;
typedef std::uint32_t shared_uint;
#define SHARED_SIZE(type, bytes) static_assert(sizeof(type) == (bytes))
#else
typedef float shared_float;
typedef int shared_int;
typedef uint shared_uint;
#define SHARED_SIZE(type, bytes) \
    typedef char type##_has_##bytes##_bytes[sizeof(type) == (bytes) ? 1 : -1]
#endif

#endif
