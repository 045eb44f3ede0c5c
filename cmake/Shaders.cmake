# Vulkan can be left out: FILIGREE_HAS_VULKAN says whether its headers, loader and glslang are there and wanted.

set(FILIGREE_VULKAN AUTO CACHE STRING "The Vulkan backend: ON, OFF, or AUTO for on where glslang and Vulkan's headers are installed")
set(FILIGREE_HAS_VULKAN OFF)
if(NOT FILIGREE_VULKAN STREQUAL "OFF")
    find_package(Vulkan QUIET COMPONENTS glslangValidator)
    if(Vulkan_FOUND)
        set(FILIGREE_HAS_VULKAN ON)
    elseif(FILIGREE_VULKAN STREQUAL "ON")
        message(FATAL_ERROR "FILIGREE_VULKAN is ON, but glslangValidator or Vulkan's headers are missing; run tools/setup")
    else()
        message(STATUS "Vulkan is left out: glslangValidator or its headers are missing (tools/setup)")
    endif()
endif()

# filigree_shader(TARGET NAME SOURCE ENVIRONMENT [DEFINITIONS...])
#
# Compiles SOURCE of shaders/ to SPIR-V, as the header NAME.h of the target with the array NAME of uint32_t.
function(filigree_shader target name source environment)
    set(folder ${PROJECT_SOURCE_DIR}/shaders)
    set(made ${CMAKE_CURRENT_BINARY_DIR}/shaders/${name}.h)
    file(GLOB includes CONFIGURE_DEPENDS ${folder}/*.glsl ${folder}/*/*.glsl)
    list(TRANSFORM ARGN PREPEND -D OUTPUT_VARIABLE definitions)
    add_custom_command(OUTPUT ${made}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/shaders
        COMMAND ${Vulkan_GLSLANG_VALIDATOR_EXECUTABLE} -V --quiet --target-env ${environment} ${definitions} -I${folder}
            --vn ${name} -o ${made} ${folder}/${source}
        DEPENDS ${folder}/${source} ${includes}
        VERBATIM)
    target_sources(${target} PRIVATE ${made})
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
