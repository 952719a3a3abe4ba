#!/bin/sh
# Grades one submission on PrairieLearn. Written by `raysteps export prairielearn`.
set -u

root=${RAYSTEPS_GRADE:-/grade}
results=$root/results/results.json
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
kit=${RAYSTEPS_KIT:-/opt/raysteps/kit}
[ -d "$kit" ] || kit=$here/kit
@KIT@
export CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-1}"
mkdir -p "$root/results"
rm -f "$results"
code=4
if cd "$kit"; then
    raysteps export prairielearn --run "$root" @OPTIONS@
    code=$?
fi
if [ ! -s "$results" ]; then
    # Not gradable: no points, and no attempt is used up.
    cat >"$results" <<'END'
{"gradable": false, "message": "The grader itself failed. Please tell your instructors.",
 "format_errors": ["The grader itself failed. Please tell your instructors."]}
END
    [ "$code" -ne 0 ] || code=4
fi
exit "$code"
