# filigree_room(NAME SOURCES ... KNOWS ... [USES ...])
#
# One static library a room. KNOWS names the rooms it may include (tools/check_rooms checks the code against
# docs/design/rooms.txt), USES the third-party targets, which stay out of its public headers.
function(filigree_room name)
    cmake_parse_arguments(ROOM "" "" "SOURCES;KNOWS;USES" ${ARGN})
    if(ROOM_SOURCES)
        add_library(filigree_${name} STATIC ${ROOM_SOURCES})
    else()
        message(FATAL_ERROR "room ${name} has no sources")
    endif()
    add_library(filigree::${name} ALIAS filigree_${name})
    target_include_directories(filigree_${name}
        PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
        PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_compile_features(filigree_${name} PUBLIC cxx_std_20)
    set_target_properties(filigree_${name} PROPERTIES EXPORT_NAME ${name}
        POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    list(TRANSFORM ROOM_KNOWS PREPEND filigree:: OUTPUT_VARIABLE known)
    target_link_libraries(filigree_${name} PUBLIC ${known} PRIVATE $<BUILD_INTERFACE:filigree_flags>)
    filigree_use(filigree_${name} ${ROOM_USES})
    filigree_in_one_go(filigree_${name} ${ROOM_SOURCES})
    set_property(GLOBAL PROPERTY filigree_${name}_knows ${ROOM_KNOWS})
    set_property(GLOBAL PROPERTY filigree_${name}_uses ${ROOM_USES})
endfunction()

# Links third-party targets; those of headers alone are of no concern to who links the room.
function(filigree_use target)
    foreach(used ${ARGN})
        if(used IN_LIST filigree_headers_alone)
            target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${used}>)
        else()
            target_link_libraries(${target} PRIVATE ${used})
        endif()
    endforeach()
endfunction()

# With FILIGREE_UNITY, compiles the sources of a target several at a time. Not those that Highway includes once a
# target.
function(filigree_in_one_go target)
    if(NOT FILIGREE_UNITY)
        return()
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    foreach(source ${ARGN})
        file(STRINGS ${source} once_a_target REGEX "define HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
        if(once_a_target)
            set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
        endif()
    endforeach()
endfunction()

# The one header of plain C is a room without sources.
add_library(filigree_lookup INTERFACE)
add_library(filigree::lookup ALIAS filigree_lookup)
target_include_directories(filigree_lookup INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>")
set_target_properties(filigree_lookup PROPERTIES EXPORT_NAME lookup)
