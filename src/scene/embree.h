// The one place that knows which Embree there is; rtcBuildBVH is the same in 3 and 4.
#pragma once

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif
