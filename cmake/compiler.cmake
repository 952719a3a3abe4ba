# What every target of the project is compiled with.
find_package(Threads REQUIRED)

add_library(raysteps-flags INTERFACE)
target_include_directories(raysteps-flags INTERFACE "${PROJECT_SOURCE_DIR}/framework" "${PROJECT_SOURCE_DIR}")
target_link_libraries(raysteps-flags INTERFACE Threads::Threads)

add_library(raysteps-strict INTERFACE)  # for the kit's own code; a student's warnings stay warnings

# M_PI, which students like, and no macros called min and max.
set(RAYSTEPS_DEFINITIONS "")
if(WIN32)
    set(RAYSTEPS_DEFINITIONS NOMINMAX _USE_MATH_DEFINES _CRT_SECURE_NO_WARNINGS)
endif()
target_compile_definitions(raysteps-flags INTERFACE ${RAYSTEPS_DEFINITIONS})

# Chains of rays are as long as --depth says, and Windows gives a program an eighth of the stack that others give it. A
# MinGW program brings its libraries, so that it runs wherever it is started.
set(RAYSTEPS_LINK_OPTIONS "")
if(MSVC)
    set(RAYSTEPS_LINK_OPTIONS /STACK:8388608)
elseif(MINGW)
    set(RAYSTEPS_LINK_OPTIONS -static -Wl,--stack,8388608)
elseif(WIN32)  # clang++ with the libraries of Visual Studio
    set(RAYSTEPS_LINK_OPTIONS -Wl,/STACK:8388608)
endif()
target_link_options(raysteps-flags INTERFACE ${RAYSTEPS_LINK_OPTIONS})

if(MSVC)
    # alignas may pad (4324)
    target_compile_options(raysteps-flags INTERFACE /W4 /permissive- /Zc:__cplusplus /utf-8 /fp:precise /wd4324)
    if(RAYSTEPS_WERROR)
        target_compile_options(raysteps-strict INTERFACE /WX)
    endif()
else()
    # Without contraction the same source gives the same picture on every machine.
    target_compile_options(raysteps-flags INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
        target_compile_options(raysteps-flags INTERFACE -Wno-restrict)  # warns about std::string + (GCC bug 105651)
    endif()
    if(RAYSTEPS_WERROR)
        target_compile_options(raysteps-strict INTERFACE -Werror)
    endif()
    if(RAYSTEPS_SANITIZE)
        target_compile_options(raysteps-flags INTERFACE "-fsanitize=${RAYSTEPS_SANITIZE}" -fno-sanitize-recover=all
                                                        -fno-omit-frame-pointer)
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            # Two false alarms of g++ 12: uninitialised values inside <regex> and std::function, and a null address
            # for a thread_local variable of another file. A true null access still stops at the address sanitizer.
            target_compile_options(raysteps-flags INTERFACE -Wno-maybe-uninitialized -fno-sanitize=null)
        endif()
        target_link_options(raysteps-flags INTERFACE "-fsanitize=${RAYSTEPS_SANITIZE}")
    endif()
endif()

# For students' files. A variable that was given no value holds the same wrong one whenever its function runs: the
# mistake shows at once, and not first on another machine. Each compiler has a value of its own; some have no such option.
include(CheckCXXCompilerFlag)
set(RAYSTEPS_STUDENTS_OPTIONS "")
if(NOT MSVC)
    check_cxx_compiler_flag(-ftrivial-auto-var-init=pattern RAYSTEPS_CAN_FILL_VARIABLES)
    if(RAYSTEPS_CAN_FILL_VARIABLES)
        set(RAYSTEPS_STUDENTS_OPTIONS -ftrivial-auto-var-init=pattern)
    endif()
endif()
