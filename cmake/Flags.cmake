# Compiler flags that every target shares.

add_library(filigree_flags INTERFACE)
target_compile_options(filigree_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
    $<$<BOOL:${FILIGREE_WERROR}>:-Werror>
    # Where sources are compiled together (FILIGREE_UNITY), their names meet.
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow>
    # Results must not vary with the instruction set, so no multiply-add is fused behind our back.
    -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 reports these falsely for inlined standard containers.
    target_compile_options(filigree_flags INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds
        -Wno-stringop-overflow -Wno-stringop-overread -Wno-restrict)
endif()
# Processors that lack SSE4 take the scalar code: each target compiles all SIMD code once more.
set(disabled HWY_SSSE3)
if(FILIGREE_SANITIZE)
    # The plain code and that of this processor are all that run here.
    set(processor "")
    if(EXISTS /proc/cpuinfo)
        file(READ /proc/cpuinfo processor LIMIT 4096)
    endif()
    if(processor MATCHES avx512vl)
        string(APPEND disabled "|HWY_SSE4|HWY_AVX2")
    elseif(processor MATCHES avx2)
        string(APPEND disabled "|HWY_SSE4|HWY_AVX3")
    endif()
    # Without the checks whose finds the address sanitizer makes too, and that of alignment, which our processors do
    # not mind: they double the time of the build.
    target_compile_options(filigree_flags INTERFACE
        -fsanitize=address,undefined -fno-sanitize=null,object-size,vptr,alignment
        -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(filigree_flags INTERFACE -fsanitize=address,undefined)
endif()
target_compile_definitions(filigree_flags INTERFACE "HWY_DISABLED_TARGETS=(${disabled})")
if(FILIGREE_FUZZ)
    target_compile_options(filigree_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
