"""The library as a folder of another project, and without its parts and their packages."""

import os
import shutil
import unittest
from pathlib import Path

from outside import OutsideTest, SOURCE, run

# What the smallest library still needs, by pkg-config.
ALWAYS = ("libhwy", "lemon", "libxxhash")
LEFT_OUT = ("TBB", "embree", "nlohmann_json", "CLI11", "Vulkan", "ZLIB", "GTest", "Python3")

EMBEDS = """
set(before "${CMAKE_BUILD_TYPE}|${CMAKE_CXX_STANDARD}|${CMAKE_CXX_FLAGS}|${BUILD_TESTING}")
add_subdirectory(${FILIGREE} filigree)
if(NOT before STREQUAL "${CMAKE_BUILD_TYPE}|${CMAKE_CXX_STANDARD}|${CMAKE_CXX_FLAGS}|${BUILD_TESTING}")
    message(FATAL_ERROR "settings of this project changed")
endif()
foreach(target filigree filigree_report filigree_jobs filigree_shared filigree_test_main)
    if(TARGET ${target})
        message(FATAL_ERROR "${target} is made unasked")
    endif()
endforeach()
get_directory_property(options COMPILE_OPTIONS)
if(options)
    message(FATAL_ERROR "compiler options leak: ${options}")
endif()
foreach(target ${WANTED})
    if(NOT TARGET filigree::${target})
        message(FATAL_ERROR "no target ${target}")
    endif()
endforeach()
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/level.cpp "#include <filigree/micromap.h>\\nint main() { return filigree::micromap::flatBytes(4, filigree::micromap::Format::fourState) != 64; }")
add_executable(level ${CMAKE_CURRENT_BINARY_DIR}/level.cpp)
target_link_libraries(level PRIVATE filigree::micromap)
"""


class Parts(OutsideTest):
    def only_needed_packages(self):
        """The environment in which pkg-config knows those packages alone."""
        kept = self.folder / "pkgconfig"
        kept.mkdir()
        for name in ALWAYS:
            found = Path(run("pkg-config", "--variable=pcfiledir", name).stdout.strip())
            shutil.copy(found / f"{name}.pc", kept)
        return kept

    def test_as_a_folder_of_another_project(self):
        embeds = self.project("embeds", EMBEDS)
        self.expect_configured(embeds, "build", f"-DFILIGREE={SOURCE}", "-DWANTED=core;bake;encoding;grid;io;trace;c;capi;lookup")

    def test_without_its_parts(self):
        os.environ["PKG_CONFIG_LIBDIR"] = str(self.only_needed_packages())
        self.addCleanup(os.environ.pop, "PKG_CONFIG_LIBDIR")
        hidden = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in LEFT_OUT]
        embeds = self.project("embeds", EMBEDS)
        self.expect_configured(embeds, "build", f"-DFILIGREE={SOURCE}", "-DWANTED=core;micromap;bake;encoding;quadmap;grid;lookup",
                               *[f"-DFILIGREE_{part}=OFF" for part in ("TBB", "IO", "TRACE", "VULKAN")], *hidden)
        if os.environ.get("FILIGREE_FULL"):
            self.expect_done("cmake", "--build", self.folder / "build")
            self.expect_done(self.folder / "build" / "level")

    def test_says_which_package_is_missing(self):
        done = self.configure(SOURCE, "build", "-DCMAKE_DISABLE_FIND_PACKAGE_embree=ON")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("embree was not found (libembree-dev in Debian); install it, or set FILIGREE_TRACE=OFF",
                      " ".join(done.stdout.split()))


if __name__ == "__main__":
    unittest.main()
