# Writes kit.json into the build folder: how a step is compiled, and what each program is linked from. The grader builds
# a submission from it without asking CMake again.
get_target_property(options raysteps-flags INTERFACE_COMPILE_OPTIONS)
set(compile_flags ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE} ${CMAKE_CXX20_STANDARD_COMPILE_OPTION} ${options}
    ${RAYSTEPS_STUDENTS_OPTIONS})
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND compile_flags -fno-gnu-unique -fmax-errors=20 -fno-diagnostics-show-caret)
elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    list(APPEND compile_flags -ferror-limit=20 -fno-caret-diagnostics)
endif()
if(RAYSTEPS_SEAL)
    # A step becomes a library that programs load. Where one has a function of the step itself, it is the one that the
    # step's other functions call.
    list(APPEND compile_flags -fPIC -fsemantic-interposition)
endif()
# What CMake adds by itself on a Mac.
set(system_flags "")
if(APPLE AND CMAKE_OSX_SYSROOT)
    list(APPEND system_flags -isysroot ${CMAKE_OSX_SYSROOT})
endif()
foreach(architecture IN LISTS CMAKE_OSX_ARCHITECTURES)
    list(APPEND system_flags -arch ${architecture})
endforeach()
if(MSVC)
    list(APPEND compile_flags /nologo /wd4100)  # parameters that a student does not use yet
else()
    list(APPEND compile_flags ${system_flags} -Wno-unused-parameter -fno-lto -fdiagnostics-color=never)
endif()
list(TRANSFORM RAYSTEPS_DEFINITIONS PREPEND "-D" OUTPUT_VARIABLE definitions)
list(APPEND compile_flags ${definitions})
list(JOIN compile_flags " " compile_flags)
separate_arguments(compile_flags)
list(JOIN compile_flags "\", \"" compile_flags)
set(link_flags ${CMAKE_EXE_LINKER_FLAGS} ${CMAKE_THREAD_LIBS_INIT} ${system_flags} ${RAYSTEPS_LINK_OPTIONS})
list(JOIN link_flags " " link_flags)
separate_arguments(link_flags)
list(JOIN link_flags "\", \"" link_flags)

set(steps_json "")
set(tests_json "")
foreach(step IN LISTS RAYSTEPS_STEPS)
    raysteps_split_step(${step} number name)
    if(RAYSTEPS_SEAL)
        set(object "${PROJECT_BINARY_DIR}/steps/${number}-${RAYSTEPS_MODEL}.o")
    else()
        set(object "$<TARGET_OBJECTS:step-${number}-${RAYSTEPS_MODEL}-raw>")
    endif()
    list(APPEND steps_json "\"${number}\": \"${object}\"")
    list(APPEND tests_json "\"${number}\": [\"$<JOIN:$<TARGET_OBJECTS:test-${number}-objects>,\", \">\"]")
endforeach()
list(JOIN steps_json ",\n    " steps_json)
list(JOIN tests_json ",\n    " tests_json)
set(catch2 "")
get_target_property(catch2_target Catch2::Catch2 ALIASED_TARGET)
if(NOT catch2_target)
    set(catch2_target Catch2::Catch2)
endif()
get_target_property(catch2_type ${catch2_target} TYPE)
if(NOT catch2_type STREQUAL "INTERFACE_LIBRARY")
    set(catch2 "\"$<TARGET_FILE:Catch2::Catch2>\"")
endif()
set(wide "")
if(TARGET raysteps-wide)
    set(wide "\"$<TARGET_OBJECTS:raysteps-wide-register>\", \"$<TARGET_FILE:raysteps-wide>\", \"$<TARGET_FILE:hwy::hwy>\"")
endif()
set(worker "")
if(TARGET worker-app)
    set(worker "\"$<JOIN:$<TARGET_OBJECTS:worker-app>,\", \">\"")
endif()
set(absent "")
if(TARGET raysteps-absent)
    set(absent "\"$<JOIN:$<TARGET_OBJECTS:raysteps-absent>,\", \">\"")
endif()
set(remote null)
if(TARGET raysteps-wire AND RAYSTEPS_SEAL)
    foreach(kind stand-in service later)
        set(${kind}_json "")
        foreach(step IN LISTS RAYSTEPS_STEPS)
            raysteps_split_step(${step} number name)
            if(TARGET ${kind}-${number})
                list(APPEND ${kind}_json "\"${number}\": \"$<TARGET_OBJECTS:${kind}-${number}>\"")
            endif()
        endforeach()
        list(JOIN ${kind}_json ", " ${kind}_json)
    endforeach()
    set(remote "{
    \"wire\": [\"$<JOIN:$<TARGET_OBJECTS:raysteps-wire>,\", \">\"],
    \"home\": \"$<TARGET_OBJECTS:raysteps-home>\",
    \"box\": \"$<TARGET_OBJECTS:raysteps-box>\",
    \"core\": \"$<TARGET_FILE:raysteps-box-core>\",
    \"stand_ins\": {${stand-in_json}},
    \"services\": {${service_json}},
    \"later\": {${later_json}}
  }")
endif()
set(driver gnu)  # whose words the compiler takes
if(MSVC)
    set(driver msvc)
endif()
set(seal_json null)
if(RAYSTEPS_SEAL)
    set(seal_json "{\"nm\": \"${CMAKE_NM}\", \"readelf\": \"${CMAKE_READELF}\", \"objcopy\": \"${CMAKE_OBJCOPY}\"}")
endif()

file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/kit.json" CONTENT "{
  \"compiler\": \"${CMAKE_CXX_COMPILER}\",
  \"driver\": \"${driver}\",
  \"compiler_version\": \"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}\",
  \"compile_flags\": [\"${compile_flags}\"],
  \"system_includes\": [\"$<JOIN:$<TARGET_PROPERTY:glm::glm,INTERFACE_INCLUDE_DIRECTORIES>,\", \">\"],
  \"link_flags\": [\"${link_flags}\"],
  \"seal\": ${seal_json},
  \"steps\": {
    ${steps_json}
  },
  \"libraries\": {
    \"core\": \"$<TARGET_FILE:raysteps-core>\",
    \"io\": \"$<TARGET_FILE:raysteps-io>\",
    \"render\": \"$<TARGET_FILE:raysteps-render>\",
    \"testing\": \"$<TARGET_FILE:raysteps-testing>\"
  },
  \"catch2\": [${catch2}],
  \"raytrace\": [\"$<JOIN:$<TARGET_OBJECTS:raytrace-app>,\", \">\"],
  \"wide\": [${wide}],
  \"worker\": [${worker}],
  \"absent\": [${absent}],
  \"remote\": ${remote},
  \"tests\": {
    ${tests_json}
  }
}
")

# All that kit.json names: `kit` for any step, `kit-NN` for what only the grades of that step and of later ones need.
add_custom_target(kit)
add_dependencies(kit raysteps-core raysteps-io raysteps-render raysteps-testing raytrace-app)
foreach(part worker-app raysteps-absent ${RAYSTEPS_REMOTE_TARGETS})
    if(TARGET ${part})
        add_dependencies(kit ${part})
    endif()
endforeach()
if(TARGET raysteps-wide)
    add_dependencies(kit raysteps-wide raysteps-wide-register)
endif()
foreach(step IN LISTS RAYSTEPS_STEPS)
    raysteps_split_step(${step} number name)
    add_dependencies(kit step-${number}-${RAYSTEPS_MODEL}-raw)
    if(RAYSTEPS_SEAL)
        add_dependencies(kit step-${number}-${RAYSTEPS_MODEL})
    endif()
    add_custom_target(kit-${number})
    foreach(part test-${number}-objects stand-in-${number} service-${number})
        if(TARGET ${part})
            add_dependencies(kit-${number} ${part})
        endif()
    endforeach()
endforeach()
