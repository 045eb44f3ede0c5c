// Comes after a public header that stands by itself: nothing but the standard library and the project may
// have come with it. After that, what the header's example uses besides.
#pragma once

#if defined(FMT_VERSION) || defined(NLOHMANN_JSON_VERSION_MAJOR) || defined(TBB_VERSION_MAJOR) ||        \
    defined(HWY_TARGETS) || defined(RTC_VERSION) || defined(VULKAN_CORE_H_) || defined(ZSTD_H_235446) || \
    defined(XXH_VERSION_NUMBER) || defined(SPNG_H)
#error "a public header shows a third party's"
#endif
#if defined(_IMMINTRIN_H_INCLUDED) || defined(_XMMINTRIN_H_INCLUDED) || defined(_EMMINTRIN_H_INCLUDED)
#error "a public header shows intrinsics"
#endif

#include <array>
#include <atomic>
#include <iostream>
#include <memory>
#include <vector>
