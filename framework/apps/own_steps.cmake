# What an instructor's own steps bring beside their functions; docs/instructors.md tells how.

# The nine steps of the kit are called by the framework and cannot be taken away.
foreach(step 01-camera-rays 02-intersection 03-phong-shading 04-shadows 05-reflection 06-octree 07-tone-mapping
        08-refraction 09-bvh)
    if(NOT step IN_LIST RAYSTEPS_STEPS AND IS_DIRECTORY "${PROJECT_SOURCE_DIR}/solutions")
        message(FATAL_ERROR "steps/${step} is missing, and the framework calls its functions. To leave it out of a "
                            "course, put both of its folders back and write `left_out = true` into its step.toml.")
    endif()
endforeach()

# `picture = "function"` in a manifest: what the step makes of the colour of a primary ray.
set(includes "")
set(offers "")
foreach(step IN LISTS RAYSTEPS_STEPS)
    raysteps_split_step(${step} number name)
    set(manifest "${PROJECT_SOURCE_DIR}/steps/${step}/step.toml")
    file(STRINGS "${manifest}" line REGEX "^picture = \"[A-Za-z0-9_]+\"" LIMIT_COUNT 1)
    if(line)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${manifest}")
        string(REGEX REPLACE "^picture = \"([A-Za-z0-9_]+)\".*" "\\1" function "${line}")
        string(REGEX REPLACE "^0" "" index ${number})
        string(APPEND includes "#include \"steps/${step}/${name}.hpp\"\n")
        string(APPEND offers "[[maybe_unused]] const bool k_offered_${number} = "
                             "raysteps::register_shading_hook(${index}, raysteps::${function});\n")
    endif()
endforeach()
set(RAYSTEPS_SHADING_HOOKS "")
if(offers)
    set(RAYSTEPS_SHADING_HOOKS "${PROJECT_BINARY_DIR}/steps/shading_hooks.cpp")
    file(CONFIGURE OUTPUT "${RAYSTEPS_SHADING_HOOKS}" CONTENT "// Made by CMake from the manifests of the steps.
#include \"render/shading_hooks.hpp\"
${includes}
namespace {
${offers}}  // namespace
" @ONLY)
endif()

# How the judge's worker asks their functions.
file(GLOB RAYSTEPS_OWN_WORKERS CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/solutions/[0-9][0-9]-*/worker.cpp")
