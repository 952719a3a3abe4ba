# Steps that are in another process: their stand-ins in the programs, and the box that a student's step is in. The kit
# links them. A students' kit has no grades, and none of this; other systems have no boxes.
if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
    return()
endif()
file(GLOB sources CONFIGURE_DEPENDS "remote/*.cpp")
list(FILTER sources EXCLUDE REGEX "_test\\.cpp$|home\\.cpp$")
add_library(raysteps-wire OBJECT ${sources})
add_library(raysteps-home OBJECT remote/home.cpp)
add_library(raysteps-box OBJECT remote/box/main.cpp)

# What a step may ask for in its box. An InwardSphere would answer half of step 02.
file(GLOB sources CONFIGURE_DEPENDS "core/*.cpp")
list(FILTER sources EXCLUDE REGEX "_test\\.cpp$|inward_sphere\\.cpp$|counting_intersect\\.cpp$")
add_library(raysteps-box-core STATIC ${sources} render/any_hit_here.cpp remote/box/hit.cpp)

set(remote_targets raysteps-wire raysteps-home raysteps-box raysteps-box-core)
foreach(number 02 06)
    add_library(later-${number} OBJECT remote/box/later_${number}.cpp)
    list(APPEND remote_targets later-${number})
endforeach()
set(RAYSTEPS_REMOTE_TARGETS ${remote_targets} PARENT_SCOPE)
foreach(step IN LISTS RAYSTEPS_STEPS)
    raysteps_split_step(${step} number name)
    if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/remote/services/${number}_${name}.cpp")
        add_library(stand-in-${number} OBJECT remote/stand_ins/${number}_${name}.cpp)
        add_library(service-${number} OBJECT remote/services/${number}_${name}.cpp)
        list(APPEND remote_targets stand-in-${number} service-${number})
    endif()
endforeach()
foreach(target IN LISTS remote_targets)
    target_link_libraries(${target} PRIVATE raysteps-flags raysteps-strict)
endforeach()
raysteps_precompile(framework ${remote_targets})
raysteps_unite(raysteps-wire)
set_source_files_properties(remote/wire.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)  # it calls the system's read() and write()
# Some systems' compilers define it by themselves; see remote/system_context.hpp. Nor may a program with fibers be taken
# for one that a shadow stack, of which there is one for each thread, can watch.
set(fiber_options -U_FORTIFY_SOURCE)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    list(APPEND fiber_options -fcf-protection=none)
endif()
set_source_files_properties(
    remote/fiber.cpp PROPERTIES COMPILE_OPTIONS "${fiber_options}" SKIP_PRECOMPILE_HEADERS ON
)
