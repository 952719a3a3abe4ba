#!/bin/sh
# Grades one submission on PrairieLearn. Written by `raysteps export prairielearn`.
# PrairieLearn reads the results only if this exits with 0, whatever has become of the submission.
set -u

root=${RAYSTEPS_GRADE:-/grade}
results=$root/results/results.json
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
kit=${RAYSTEPS_KIT:-/opt/raysteps/kit}
@UNPACK@
@KIT@
export CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-1}"
mkdir -p "$root/results"
rm -rf "$results"
# The solutions are in these: the same files under their present name and under their former one.
for folder in "$root/serverFilesCourse" "$root/shared"; do
    [ ! -d "$folder" ] || chmod -R go= "$folder"
done
if { [ -d "$kit" ] || unpack; } && cd "$kit"; then
    raysteps export prairielearn --run "$root" @OPTIONS@ "$@"
fi
if [ ! -s "$results" ]; then
    # Not gradable: no points, and no attempt is used up.
    cat >"$results" <<'END'
{"gradable": false, "message": "The grader itself failed.",
 "format_errors": ["This submission was not graded. No attempt was used up. Please tell your instructors."]}
END
fi
exit 0
