# GLM, Catch2 2 and stb are headers only, so a compiler for another system can take those of this one. They are copied,
# for beside them lie the headers of this system's C library, which fit no other.
function(raysteps_take_headers library folder header)
    find_path(found "${folder}/${header}" PATHS /usr/include /usr/local/include /opt/homebrew/include
              NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH NO_CACHE)
    if(NOT found)
        return()  # fetched instead
    endif()
    set(copies "${PROJECT_BINARY_DIR}/headers/${folder}")
    file(MAKE_DIRECTORY "${copies}")
    file(COPY "${found}/${folder}" DESTINATION "${copies}")
    add_library(${library} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${library} INTERFACE "${copies}")
endfunction()

raysteps_take_headers(glm::glm glm glm.hpp)
raysteps_take_headers(Catch2::Catch2 catch2 catch.hpp)
raysteps_take_headers(stb::stb stb stb_image_write.h)
if(TARGET stb::stb)
    target_include_directories(stb::stb INTERFACE "${PROJECT_BINARY_DIR}/headers/stb/stb")
endif()
