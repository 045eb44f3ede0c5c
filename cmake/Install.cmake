# What `cmake --install` puts where, by the components command, runtime and development; and the files by which
# others find it: find_package(filigree COMPONENTS ...) and pkg-config.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(filigree_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/filigree)
set(filigree_headers_dir ${CMAKE_INSTALL_INCLUDEDIR}/filigree)

# filigree_install(COMPONENT TARGET): the target and an export file of its own, so that who wants one component need not
# have the packages of the others.
function(filigree_install component target)
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${component})
    target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    install(TARGETS ${target} EXPORT filigree_${component}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development)
    install(EXPORT filigree_${component} NAMESPACE filigree:: FILE filigree-${component}.cmake
        DESTINATION ${filigree_cmake_dir} COMPONENT development)
endfunction()

# filigree_component(COMPONENT TARGET): installs it, and notes for the configuration what it knows and uses.
macro(filigree_component component target)
    filigree_install(${component} ${target})
    list(APPEND filigree_components ${component})
    get_property(knows GLOBAL PROPERTY ${target}_knows)
    foreach(known ${knows})
        list(APPEND knows ${filigree_${known}_knows})
    endforeach()
    list(REMOVE_DUPLICATES knows)
    set(filigree_${component}_knows ${knows})
    get_property(uses GLOBAL PROPERTY ${target}_uses)
    list(REMOVE_ITEM uses ${filigree_headers_alone})
    set(filigree_${component}_uses ${uses})
    string(APPEND filigree_facts "set(filigree_${component}_knows ${knows})\nset(filigree_${component}_uses ${uses})\n")
endmacro()

set(filigree_components "")
set(filigree_facts "")
filigree_component(lookup filigree_lookup)
install(FILES include/filigree_lookup.h TYPE INCLUDE COMPONENT development)
foreach(room ${filigree_rooms})
    if(room STREQUAL "capi")
        filigree_component(c filigree_capi)
        install(FILES include/filigree.h TYPE INCLUDE COMPONENT development)
    else()
        filigree_component(${room} filigree_${room})
        install(FILES include/filigree/${room}.h DESTINATION ${filigree_headers_dir} COMPONENT development)
        install(DIRECTORY include/filigree/${room} DESTINATION ${filigree_headers_dir} COMPONENT development)
    endif()
endforeach()

if(FILIGREE_SHARED)
    filigree_component(shared filigree_shared)
    file(RELATIVE_PATH filigree_pc_up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
    configure_file(cmake/filigree.pc.in filigree.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/filigree.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endif()

configure_package_config_file(cmake/filigree-config.cmake.in filigree-config.cmake
    INSTALL_DESTINATION ${filigree_cmake_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(filigree-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/packages.cmake ${PROJECT_BINARY_DIR}/filigree-config.cmake
    ${PROJECT_BINARY_DIR}/filigree-config-version.cmake
    DESTINATION ${filigree_cmake_dir} COMPONENT development)

if(FILIGREE_COMMAND)
    install(TARGETS filigree RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
    install(FILES tools/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME filigree COMPONENT command)
    # The manual is what the command says of itself.
    find_package(Python3 COMPONENTS Interpreter)
    if(Python3_FOUND AND NOT FILIGREE_SANITIZE)
        set(manual ${PROJECT_BINARY_DIR}/filigree.1)
        add_custom_command(OUTPUT ${manual}
            COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/tools/manual $<TARGET_FILE:filigree> ${manual}
            DEPENDS filigree ${PROJECT_SOURCE_DIR}/tools/manual
            VERBATIM)
        add_custom_target(filigree_manual ALL DEPENDS ${manual})
        install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
    endif()
endif()
