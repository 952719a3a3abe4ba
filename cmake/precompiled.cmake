# Headers that nearly every source reads are compiled once for all of them; they take 200 MB. For the kit's own sources
# alone: what a student's files are compiled with stays plain, and so does what clang-tidy reads, which shows a missing
# #include.
set(precompile OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND RAYSTEPS_MODEL STREQUAL "reference" AND NOT CMAKE_HOST_WIN32)
    set(precompile ON)
endif()
option(RAYSTEPS_PRECOMPILE "Compile the common headers once, for a quicker build" ${precompile})

# ccache takes precompiled headers only when it is told that these macros change nothing in them. Comments count, since
# GCC knows a header with `#pragma once` again by its bytes: headers compiled before a comment was changed would be read
# a second time. Clang's hold the times of the headers that they were made from, and would be refused in another clone.
if(RAYSTEPS_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_LAUNCHER STREQUAL "ccache")
    set(settings CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_COMMENTS=1)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env ${settings} ccache)
endif()

# An object library that carries compiled headers: raysteps_carry_headers(NAME HEADER... [LIBRARIES LIBRARY...])
function(raysteps_carry_headers name)
    cmake_parse_arguments(arg "" "" "LIBRARIES" ${ARGN})
    set(source "${PROJECT_BINARY_DIR}/precompiled/${name}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "// Made by CMake, to have something to compile.\n" @ONLY)
    add_library(${name} OBJECT "${source}")
    target_link_libraries(${name} PRIVATE raysteps-flags raysteps-strict ${arg_LIBRARIES})
    target_precompile_headers(${name} PRIVATE ${arg_UNPARSED_ARGUMENTS})
endfunction()

if(RAYSTEPS_PRECOMPILE)
    raysteps_carry_headers(precompiled-framework "<algorithm>" "<cmath>" "<filesystem>" "<functional>" "<map>"
                           "<memory>" "<optional>" "<sstream>" "<string>" "<variant>" "<vector>"
                           "${PROJECT_SOURCE_DIR}/framework/core/scene.hpp")
    raysteps_carry_headers(precompiled-testing "${PROJECT_SOURCE_DIR}/framework/testing/testing.hpp"
                           LIBRARIES Catch2::Catch2)
endif()

# Gives targets the headers of one of the two: raysteps_precompile(framework|testing TARGET...)
function(raysteps_precompile which)
    if(RAYSTEPS_PRECOMPILE)
        foreach(target IN LISTS ARGN)
            target_precompile_headers(${target} REUSE_FROM precompiled-${which})
        endforeach()
    endif()
endfunction()
