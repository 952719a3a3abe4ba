# Test programs: one per step and source, and one for the framework itself.
function(raysteps_add_test name)
    cmake_parse_arguments(arg "" "" "SOURCES;MINE" ${ARGN})
    add_executable(${name} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE raysteps-testing raysteps-render raysteps-io raysteps-core raysteps-strict)
    raysteps_link_steps(${name} ${arg_MINE})
endfunction()

# Tests are compiled more often than they run, and what they test is compiled as always.
function(raysteps_compile_quickly target)
    if(NOT MSVC)
        target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
    endif()
endfunction()

set(up_to "")
set(step_tests "")
foreach(step IN LISTS RAYSTEPS_STEPS)
    raysteps_split_step(${step} number step_name)
    list(APPEND up_to ${number})
    file(GLOB tests CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/steps/${step}/*_test.cpp")
    add_library(test-${number}-objects OBJECT ${tests})
    target_link_libraries(test-${number}-objects PRIVATE raysteps-testing raysteps-strict)
    raysteps_precompile(testing test-${number}-objects)
    raysteps_compile_quickly(test-${number}-objects)
    list(APPEND step_tests $<TARGET_OBJECTS:test-${number}-objects>)
    if(RAYSTEPS_MODEL STREQUAL "reference")
        raysteps_add_test(test-reference-${number} SOURCES $<TARGET_OBJECTS:test-${number}-objects>)
        raysteps_add_test(test-isolated-${number} SOURCES $<TARGET_OBJECTS:test-${number}-objects> MINE ${number})
        add_test(NAME test-isolated-${number} COMMAND test-isolated-${number})
    else()  # among the student's own steps; later ones are stubs, so that they break nothing here
        raysteps_add_test(test-isolated-${number} SOURCES $<TARGET_OBJECTS:test-${number}-objects> MINE ${up_to})
        add_test(NAME test-isolated-${number} COMMAND test-isolated-${number})
    endif()
endforeach()
if(NOT RAYSTEPS_MODEL STREQUAL "reference")
    return()
endif()

# What follows tests the kit itself, with the reference.

# The grader links it into programs of its own; here every compiler shows its warnings.
if(NOT WIN32)
    add_library(crash-report OBJECT testing/crash_report.cpp)
    target_link_libraries(crash-report PRIVATE raysteps-flags raysteps-strict)
endif()

# The tests of all steps in one program, for where linking is slow: MinGW's linker takes half a minute for each.
raysteps_add_test(test-reference SOURCES ${step_tests})
set_target_properties(test-reference PROPERTIES EXCLUDE_FROM_ALL ON)

file(GLOB framework_tests CONFIGURE_DEPENDS "core/*_test.cpp" "io/*_test.cpp" "render/*_test.cpp" "apps/*_test.cpp"
     "inspect/*_test.cpp" "testing/*_test.cpp" "view/*_test.cpp" "wide/*_test.cpp")
if(NOT TARGET raysteps-wide)
    list(FILTER framework_tests EXCLUDE REGEX "wide/collapse_test\\.cpp$")  # the others find no wide tree
endif()
if(TARGET raysteps-wire)
    file(GLOB remote_tests CONFIGURE_DEPENDS "remote/*_test.cpp")
    # As fibers change on processors for which asm_context.hpp has no instructions.
    add_library(portable-fibers OBJECT remote/fiber.cpp remote/fiber_test.cpp)
    target_compile_definitions(portable-fibers PRIVATE RAYSTEPS_PORTABLE_FIBERS Fiber=PortableFiber)
    target_link_libraries(portable-fibers PRIVATE raysteps-testing raysteps-flags raysteps-strict)
    list(APPEND framework_tests ${remote_tests} $<TARGET_OBJECTS:raysteps-wire> $<TARGET_OBJECTS:portable-fibers>)
endif()
raysteps_add_test(test-framework SOURCES ${framework_tests} apps/options.cpp apps/stats_json.cpp apps/spd_report.cpp
                  apps/inspect_options.cpp apps/view_options.cpp $<TARGET_OBJECTS:raysteps-inspect-recorded>)
target_link_libraries(test-framework PRIVATE raysteps-view raysteps-inspect raysteps-render raysteps-io raysteps-core)
raysteps_precompile(testing test-framework)
raysteps_compile_quickly(test-framework)
raysteps_link_wide(test-framework)

# The readers against broken files: replayed with any compiler, and searched for new ones with libFuzzer.
add_executable(fuzz-readers-replay io/fuzz/readers_fuzz.cpp io/fuzz/replay_main.cpp)
target_link_libraries(fuzz-readers-replay PRIVATE raysteps-io raysteps-core raysteps-strict)
raysteps_link_steps(fuzz-readers-replay)
if(RAYSTEPS_FUZZ)
    add_executable(fuzz-readers io/fuzz/readers_fuzz.cpp)
    target_link_libraries(fuzz-readers PRIVATE raysteps-io raysteps-core raysteps-strict)
    target_link_options(fuzz-readers PRIVATE -fsanitize=fuzzer)
    raysteps_link_steps(fuzz-readers)
endif()
