# Each library from the system when it is there, else fetched at a pinned commit.
include(FetchContent)
if(CMAKE_CROSSCOMPILING)
    include(header_libraries)
endif()

if(NOT TARGET glm::glm)
    find_package(glm CONFIG QUIET)
endif()
if(NOT TARGET glm::glm)
    message(STATUS "GLM is not installed: fetching 1.0.1")
    FetchContent_Declare(glm GIT_REPOSITORY https://github.com/g-truc/glm.git
                             GIT_TAG 0af55ccecd98d4e5a8d1fad7de25ba429d60e863)
    FetchContent_MakeAvailable(glm)
endif()
target_link_libraries(raysteps-flags INTERFACE glm::glm)

if(NOT TARGET Catch2::Catch2)
    find_package(Catch2 QUIET)
endif()
if(NOT TARGET Catch2::Catch2)
    message(STATUS "Catch2 is not installed: fetching 3.7.1")
    FetchContent_Declare(Catch2 GIT_REPOSITORY https://github.com/catchorg/Catch2.git
                                GIT_TAG fa43b77429ba76c462b1898d6cd2f2d7a9416b14)
    FetchContent_MakeAvailable(Catch2)
endif()

# Two headers: stb_image for textures, stb_image_write for PNG.
if(NOT TARGET stb::stb)
    find_path(RAYSTEPS_STB_FOLDER stb_image_write.h PATH_SUFFIXES stb)
    if(NOT RAYSTEPS_STB_FOLDER)
        message(STATUS "stb_image_write is not installed: fetching 1.16")
        FetchContent_Declare(stb GIT_REPOSITORY https://github.com/nothings/stb.git
                                 GIT_TAG 31c1ad37456438565541f4919958214b6e762fb4)
        FetchContent_MakeAvailable(stb)
        set(RAYSTEPS_STB_FOLDER "${stb_SOURCE_DIR}")
    endif()
    add_library(stb::stb INTERFACE IMPORTED GLOBAL)
    target_include_directories(stb::stb SYSTEM INTERFACE "${RAYSTEPS_STB_FOLDER}")
endif()

# For the wide trees alone: where it is missing there are none.
find_package(hwy 1.0 CONFIG QUIET)

# For the window alone: where they are missing there is none.
find_package(glfw3 3.3 CONFIG QUIET)
set(OpenGL_GL_PREFERENCE GLVND)
find_package(OpenGL QUIET)
if(TARGET glfw AND TARGET OpenGL::GL)
    set(RAYSTEPS_WINDOW ON CACHE INTERNAL "Whether the targets view-mine and view-reference are there")
else()
    set(RAYSTEPS_WINDOW OFF CACHE INTERNAL "Whether the targets view-mine and view-reference are there")
    message(STATUS "GLFW 3.3 or OpenGL is not installed: no window for `./raysteps view` (Debian: libglfw3-dev)")
endif()

# Their headers are theirs: no warnings from them.
foreach(library glm::glm Catch2::Catch2)
    get_target_property(target ${library} ALIASED_TARGET)
    if(NOT target)
        set(target ${library})
    endif()
    get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
    if(folders)
        set_target_properties(${target} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${folders}")
    endif()
endforeach()
