# Any step from any source, chosen when a program is linked.
#
# Each step is compiled twice, from RAYSTEPS_MINE_DIR (mine) and from solutions/ (reference). The object is then
# sealed: only the functions that the reference of the same step offers stay visible. So helpers of the same name
# in two of a student's files do not collide, and no step can replace a function of the framework or of another
# step. Where the tools for that are missing (macOS, Windows, sanitizers) objects are linked as they are.
set(RAYSTEPS_STEPS
    01-camera-rays 02-intersection 03-phong-shading 04-shadows 05-reflection 06-octree 07-tone-mapping 08-refraction
    09-bvh)

set(RAYSTEPS_SEAL OFF)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT RAYSTEPS_SANITIZE AND CMAKE_LINKER AND CMAKE_OBJCOPY AND CMAKE_NM)
    execute_process(COMMAND "${CMAKE_LINKER}" --help OUTPUT_VARIABLE linker_help ERROR_QUIET)
    if(linker_help MATCHES "force-group-allocation")
        set(RAYSTEPS_SEAL ON)
    endif()
endif()

# 02-intersection -> 02 and intersection
function(raysteps_split_step step number name)
    string(SUBSTRING ${step} 0 2 digits)
    string(SUBSTRING ${step} 3 -1 rest)
    string(REPLACE "-" "_" rest ${rest})
    set(${number} ${digits} PARENT_SCOPE)
    set(${name} ${rest} PARENT_SCOPE)
endfunction()

# Compiles one step: target step-NN-VARIANT-raw, and its sealed object where sealing is on.
function(raysteps_add_step step variant source)
    raysteps_split_step(${step} number name)
    set(raw step-${number}-${variant}-raw)
    add_library(${raw} OBJECT "${source}")
    target_link_libraries(${raw} PRIVATE raysteps-flags)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${raw} PRIVATE -fno-gnu-unique)  # unique symbols are shared whatever a seal says
    endif()
    if(variant STREQUAL "mine")
        target_compile_options(${raw} PRIVATE $<IF:$<BOOL:${MSVC}>,/wd4100,-Wno-unused-parameter>)
    else()
        target_link_libraries(${raw} PRIVATE raysteps-strict)
    endif()
    if(RAYSTEPS_SEAL)
        set(sealed "${PROJECT_BINARY_DIR}/steps/${number}-${variant}.o")
        set(model "$<TARGET_OBJECTS:step-${number}-reference-raw>")
        add_custom_command(
            OUTPUT "${sealed}"
            COMMAND ${CMAKE_COMMAND} "-DINPUT=$<TARGET_OBJECTS:${raw}>" "-DMODEL=${model}" "-DOUTPUT=${sealed}"
                    "-DNM=${CMAKE_NM}" "-DLD=${CMAKE_LINKER}" "-DOBJCOPY=${CMAKE_OBJCOPY}"
                    -P "${PROJECT_SOURCE_DIR}/cmake/seal.cmake"
            DEPENDS ${raw} step-${number}-reference-raw "$<TARGET_OBJECTS:${raw}>" "${model}"
                    "${PROJECT_SOURCE_DIR}/cmake/seal.cmake"
            COMMENT "Sealing step ${step} (${variant})"
            VERBATIM)
        add_custom_target(step-${number}-${variant} DEPENDS "${sealed}")
    endif()
endfunction()

# Links a program with one choice per step: mine for the numbers listed, reference for all others.
function(raysteps_link_steps program)
    foreach(step IN LISTS RAYSTEPS_STEPS)
        raysteps_split_step(${step} number name)
        set(variant reference)
        if(number IN_LIST ARGN)
            set(variant mine)
        endif()
        if(RAYSTEPS_SEAL)
            set(sealed "${PROJECT_BINARY_DIR}/steps/${number}-${variant}.o")
            set_source_files_properties("${sealed}" PROPERTIES GENERATED ON EXTERNAL_OBJECT ON)
            target_sources(${program} PRIVATE "${sealed}")
            add_dependencies(${program} step-${number}-${variant})
        else()
            target_sources(${program} PRIVATE $<TARGET_OBJECTS:step-${number}-${variant}-raw>)
        endif()
    endforeach()
endfunction()
