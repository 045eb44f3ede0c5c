# libfiligree.so: the objects of all rooms, of which it shows what FILIGREE_API marks.

add_library(filigree_shared SHARED)
add_library(filigree::shared ALIAS filigree_shared)
foreach(room ${filigree_rooms})
    target_sources(filigree_shared PRIVATE $<TARGET_OBJECTS:filigree_${room}>)
    get_property(uses GLOBAL PROPERTY filigree_${room}_uses)
    filigree_use(filigree_shared ${uses})
endforeach()
target_link_libraries(filigree_shared PRIVATE $<BUILD_INTERFACE:filigree_flags>)
target_include_directories(filigree_shared INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>")
set_target_properties(filigree_shared PROPERTIES OUTPUT_NAME filigree EXPORT_NAME shared LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})

# Instances of the standard library's templates are shown whatever the compiler is told: the linker hides them.
target_link_options(filigree_shared PRIVATE -Wl,--version-script=${CMAKE_CURRENT_LIST_DIR}/shown.map)
set_target_properties(filigree_shared PROPERTIES LINK_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/shown.map)
if(NOT FILIGREE_SANITIZE)
    target_link_options(filigree_shared PRIVATE -Wl,--no-undefined)
endif()
