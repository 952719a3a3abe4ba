# Several sources of a library in one go read what they include once, in half the time. Where the kit is worked on, each
# stands for itself: that shows a missing #include.
option(RAYSTEPS_UNITY "Compile several of the framework's sources in one go, for a quicker build" OFF)

# raysteps_unite(TARGET...)
function(raysteps_unite)
    if(RAYSTEPS_UNITY)
        set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            foreach(target IN LISTS ARGN)  # false alarms, about strings and about sources within a source
                target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow
                                                         -Wno-subobject-linkage)
            endforeach()
        endif()
    endif()
endfunction()
