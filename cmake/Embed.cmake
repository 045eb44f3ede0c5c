# filigree_embed(TARGET HEADER NAMESPACE FILES...)
#
# Text files as constants of a C++ source that is made at build time: `page.css` becomes `page_css`, a
# std::string_view that HEADER declares.
function(filigree_embed target header namespace)
    set(made ${CMAKE_CURRENT_BINARY_DIR}/${target}_assets.cpp)
    list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE files)
    list(JOIN files "|" joined)
    add_custom_command(OUTPUT ${made}
        COMMAND ${CMAKE_COMMAND} -D "FILES=${joined}" -D HEADER=${header} -D NAMESPACE=${namespace} -D OUT=${made}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake
        DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake
        VERBATIM)
    target_sources(${target} PRIVATE ${made})
    set_source_files_properties(${made} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
