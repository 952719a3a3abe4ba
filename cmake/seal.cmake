# Makes OUTPUT from INPUT: the same code, but only the functions that MODEL offers can be seen from outside.
# Run as a script with INPUT, MODEL, OUTPUT, NM, LD and OBJCOPY set.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE error)
    if(NOT result EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\n${error}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

run("${NM}" --defined-only --extern-only --format=posix "${MODEL}")
string(REGEX MATCHALL "[^\n]+ T [^\n]*" lines "${output}")
set(names "")
foreach(line IN LISTS lines)
    string(REGEX REPLACE " T .*" "" name "${line}")
    string(APPEND names "${name}\n")
endforeach()
file(WRITE "${OUTPUT}.keep" "${names}")

# Inline functions and templates sit in groups that a linker merges by name across files. --force-group-allocation
# dissolves the groups, so that each file keeps its own.
run("${LD}" -r --force-group-allocation -o "${OUTPUT}.tmp" "${INPUT}")
run("${OBJCOPY}" "--keep-global-symbols=${OUTPUT}.keep" "${OUTPUT}.tmp" "${OUTPUT}")
file(REMOVE "${OUTPUT}.tmp")
