# Debian packages: cpack -G DEB. `filigree` is the command, `libfiligree` the shared library, `libfiligree-dev` what
# programs are built with.

# The static libraries are linked with what the rooms use.
set(wanted "libfiligree (= ${PROJECT_VERSION})" pkg-config)
foreach(component ${filigree_components})
    foreach(used ${filigree_${component}_uses})
        list(APPEND wanted ${filigree_debian_${used}})
    endforeach()
endforeach()
list(REMOVE_DUPLICATES wanted)
list(REMOVE_ITEM wanted libc6-dev)
list(JOIN wanted ", " wanted)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME filigree)
set(CPACK_PACKAGE_CONTACT "The Filigree developers <filigree@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_COMPONENTS_ALL runtime development)
if(FILIGREE_COMMAND)
    list(APPEND CPACK_COMPONENTS_ALL command)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME filigree)
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "Opacity micromaps and vertex grids: the command
 Bakes opacity micromaps from alpha textures, proves and compresses them,
 turns meshes to vertex grids, and renders with either.")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libfiligree)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(control ${PROJECT_BINARY_DIR}/debian)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${control}/triggers;${control}/shlibs")
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
file(WRITE ${control}/shlibs "libfiligree ${PROJECT_VERSION_MAJOR} libfiligree (>= ${PROJECT_VERSION})\n")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Opacity micromaps and vertex grids: the shared library
 The C++ and C interfaces of Filigree as one shared library.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfiligree-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${wanted}")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Opacity micromaps and vertex grids: headers and static libraries
 What programs are built with: C++ and C headers, the one header that looks
 micromaps up, static libraries, and files for CMake and pkg-config.")

include(CPack)
