// The one place that knows which Embree there is, in the order of CMakeLists.txt; rtcBuildBVH is
// the same in 3 and 4.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
