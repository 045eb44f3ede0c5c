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
endfunction()
