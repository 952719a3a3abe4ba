# raytrace, linked with every choice of steps that a student or the grader needs.
set(sources apps/raytrace.cpp apps/options.cpp apps/stats_json.cpp)
if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/apps/spd_report.cpp")  # a students' kit does without
    list(APPEND sources apps/spd_report.cpp)
endif()
add_library(raytrace-app OBJECT ${sources} ${RAYSTEPS_SHADING_HOOKS})
target_link_libraries(raytrace-app PRIVATE raysteps-flags raysteps-strict)
raysteps_precompile(framework raytrace-app)

# name, then the numbers of the steps that are mine
function(raysteps_add_raytrace name)
    add_executable(${name} $<TARGET_OBJECTS:raytrace-app>)
    target_link_libraries(${name} PRIVATE raysteps-render raysteps-io raysteps-core)
    raysteps_link_steps(${name} ${ARGN})
endfunction()

set(numbers "")
foreach(step IN LISTS RAYSTEPS_STEPS)
    raysteps_split_step(${step} number step_name)
    list(APPEND numbers ${number})
endforeach()
raysteps_add_raytrace(raytrace-mine ${numbers})
if(RAYSTEPS_MODEL STREQUAL "reference")
    raysteps_add_raytrace(raytrace-reference)
    raysteps_link_wide(raytrace-reference)
endif()

# inspect, the life of one pixel.
add_library(inspect-app OBJECT apps/inspect.cpp apps/inspect_options.cpp apps/options.cpp ${RAYSTEPS_SHADING_HOOKS})
target_link_libraries(inspect-app PRIVATE raysteps-flags raysteps-strict)
raysteps_precompile(framework inspect-app)

function(raysteps_add_inspect name)
    add_executable(${name} $<TARGET_OBJECTS:inspect-app> $<TARGET_OBJECTS:raysteps-inspect-recorded>)
    target_link_libraries(${name} PRIVATE raysteps-inspect raysteps-render raysteps-io raysteps-core)
    raysteps_link_steps(${name} ${ARGN})
endfunction()

raysteps_add_inspect(inspect-mine ${numbers})
if(RAYSTEPS_MODEL STREQUAL "reference")
    raysteps_add_inspect(inspect-reference)
endif()

# view, a window on a scene.
if(RAYSTEPS_WINDOW)
    file(GLOB sources CONFIGURE_DEPENDS "view/window*.cpp")
    add_library(view-app OBJECT apps/view.cpp apps/view_options.cpp apps/options.cpp view/viewer.cpp ${sources}
                ${RAYSTEPS_SHADING_HOOKS})
    target_link_libraries(view-app PRIVATE raysteps-flags raysteps-strict glfw OpenGL::GL)
    raysteps_precompile(framework view-app)
    target_compile_definitions(view-app PRIVATE GL_SILENCE_DEPRECATION)  # a Mac calls all of OpenGL deprecated

    function(raysteps_add_view name)
        add_executable(${name} $<TARGET_OBJECTS:view-app> $<TARGET_OBJECTS:raysteps-inspect-recorded>)
        target_link_libraries(${name} PRIVATE raysteps-view raysteps-inspect raysteps-render raysteps-io raysteps-core
                                              glfw OpenGL::GL)
        raysteps_link_steps(${name} ${ARGN})
    endfunction()

    raysteps_add_view(view-mine ${numbers})
    if(RAYSTEPS_MODEL STREQUAL "reference")
        raysteps_add_view(view-reference)
    endif()
endif()

# worker, which answers the judge's cases with the functions that it is linked with. The kit links it.
file(GLOB sources CONFIGURE_DEPENDS "worker/*.cpp")
if(sources)  # a students' kit has no judge
    add_library(worker-app OBJECT ${sources} ${RAYSTEPS_OWN_WORKERS})
    target_link_libraries(worker-app PRIVATE raysteps-flags raysteps-strict)
    raysteps_precompile(framework worker-app)
    raysteps_unite(worker-app)
    if(RAYSTEPS_OWN_WORKERS)  # an instructor's, which may use any names
        set_source_files_properties(${RAYSTEPS_OWN_WORKERS} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
endif()
