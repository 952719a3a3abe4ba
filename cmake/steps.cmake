# Any step from any source, chosen when a program is linked.
#
# Each step is compiled twice, from RAYSTEPS_MINE_DIR (mine) and from solutions/ (reference); a students' kit has no
# solutions, and its stubs stand in for them. The object is then sealed: only the functions that the reference (or the
# stub) of the same step offers stay visible. So helpers of the same name in two of a student's files do not collide,
# and no step can replace a function of the framework or of another step. Where the tools for that are missing (macOS,
# Windows, sanitizers) objects are linked as they are.

# The steps are the folders of steps/ that hold a manifest, in the order of their numbers.
file(GLOB RAYSTEPS_STEPS CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/steps"
     "${PROJECT_SOURCE_DIR}/steps/[0-9][0-9]-*/step.toml")
list(TRANSFORM RAYSTEPS_STEPS REPLACE "/step.toml$" "")
list(SORT RAYSTEPS_STEPS)

if(IS_DIRECTORY "${PROJECT_SOURCE_DIR}/solutions")
    set(RAYSTEPS_MODEL reference)
    set(RAYSTEPS_MODEL_DIR "${PROJECT_SOURCE_DIR}/solutions")
else()
    set(RAYSTEPS_MODEL stub)
    set(RAYSTEPS_MODEL_DIR "${PROJECT_SOURCE_DIR}/grader/stubs")
endif()

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
    if(variant STREQUAL "mine" AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND NOT MSVC)
        # A stub says where it stands: as seen from the kit, where a student is, and not from the folder of the build.
        file(RELATIVE_PATH up "${CMAKE_BINARY_DIR}" "${PROJECT_SOURCE_DIR}")
        string(REGEX REPLACE "/$" "" up "${up}")
        target_compile_options(${raw} PRIVATE "-fmacro-prefix-map=${up}/=" "-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=")
    endif()
    if(variant STREQUAL "stub")
        set_target_properties(${raw} PROPERTIES POSITION_INDEPENDENT_CODE ON)  # becomes a library, as a student's does
    endif()
    if(NOT variant STREQUAL "reference")
        target_compile_options(${raw} PRIVATE $<IF:$<BOOL:${MSVC}>,/wd4100,-Wno-unused-parameter>
                                              ${RAYSTEPS_STUDENTS_OPTIONS})
    else()
        target_link_libraries(${raw} PRIVATE raysteps-strict)
    endif()
    if(RAYSTEPS_SEAL)
        set(sealed "${PROJECT_BINARY_DIR}/steps/${number}-${variant}.o")
        set(model_target step-${number}-${RAYSTEPS_MODEL}-raw)
        set(model "$<TARGET_OBJECTS:${model_target}>")
        add_custom_command(
            OUTPUT "${sealed}"
            COMMAND ${CMAKE_COMMAND} "-DINPUT=$<TARGET_OBJECTS:${raw}>" "-DMODEL=${model}" "-DOUTPUT=${sealed}"
                    "-DNM=${CMAKE_NM}" "-DLD=${CMAKE_LINKER}" "-DOBJCOPY=${CMAKE_OBJCOPY}"
                    -P "${PROJECT_SOURCE_DIR}/cmake/seal.cmake"
            DEPENDS ${raw} ${model_target} "$<TARGET_OBJECTS:${raw}>" "${model}"
                    "${PROJECT_SOURCE_DIR}/cmake/seal.cmake"
            COMMENT "Sealing step ${step} (${variant})"
            VERBATIM)
        add_custom_target(step-${number}-${variant} DEPENDS "${sealed}")
    endif()
endfunction()

# Links a program with one choice per step: mine for the numbers listed, the reference (or the stub) for all others.
function(raysteps_link_steps program)
    foreach(step IN LISTS RAYSTEPS_STEPS)
        raysteps_split_step(${step} number name)
        set(variant ${RAYSTEPS_MODEL})
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
    if(TARGET raysteps-absent)
        target_sources(${program} PRIVATE $<TARGET_OBJECTS:raysteps-absent>)
    endif()
endfunction()
