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
        PUBLIC ${PROJECT_SOURCE_DIR}/include
        PRIVATE ${PROJECT_SOURCE_DIR}/src)
    list(TRANSFORM ROOM_KNOWS PREPEND filigree::)
    target_link_libraries(filigree_${name} PUBLIC ${ROOM_KNOWS} PRIVATE filigree_flags ${ROOM_USES})
    filigree_in_one_go(filigree_${name} ${ROOM_SOURCES})
endfunction()

# With FILIGREE_UNITY, compiles the sources of a target several at a time. Not those that Highway includes once a
# target.
function(filigree_in_one_go target)
    if(NOT FILIGREE_UNITY)
        return()
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 20)
    foreach(source ${ARGN})
        file(STRINGS ${source} once_a_target REGEX "define HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
        if(once_a_target)
            set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
        endif()
    endforeach()
endfunction()
