# Third-party libraries, all from Debian: tools/setup lists the packages. What an option leaves out is not looked for.

include(${CMAKE_CURRENT_LIST_DIR}/packages.cmake)

# filigree_need(REMEDY TARGETS...): they must be there, or the build stops and tells the remedy.
macro(filigree_need remedy)
    filigree_find(filigree_missing ${ARGN})
    if(filigree_missing)
        message(FATAL_ERROR "filigree: ${filigree_missing}; ${remedy}")
    endif()
endmacro()

filigree_need("install it" Threads::Threads fmt::fmt PkgConfig::HWY PkgConfig::LEMON PkgConfig::XXHASH)
if(FILIGREE_TBB)
    filigree_need("install it, or set FILIGREE_TBB=OFF for threads without it" TBB::tbb)
endif()
if(FILIGREE_IO)
    filigree_need("install it, or set FILIGREE_IO=OFF to leave out files and the C API"
        nlohmann_json::nlohmann_json PkgConfig::SPNG PkgConfig::TURBOJPEG PkgConfig::ZSTD)
endif()
if(FILIGREE_TRACE)
    filigree_need("install it, or set FILIGREE_TRACE=OFF to leave out pictures by Embree" embree)
endif()
if(FILIGREE_COMMAND)
    filigree_need("install it, or set FILIGREE_COMMAND=OFF to leave out the command"
        ZLIB::ZLIB CLI11::CLI11 PkgConfig::MD)
endif()
