#!/bin/sh
# Grades one submission on Autolab: driver.sh HANDIN. Written by `raysteps export autolab`.
# What is printed is shown to the student; the last line is what Autolab reads.
set -u

handin=$(pwd -P)/${1:?the file that was handed in}
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
kit=${RAYSTEPS_KIT:-/opt/raysteps/kit}
[ -d "$kit" ] || kit=$here/kit
@KIT@
export CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-1}"
code=4
if cd "$kit"; then
    raysteps export autolab --run "$handin" @OPTIONS@
    code=$?
fi
if [ "$code" -ne 0 ]; then
    # No line of scores: Autolab gives none, and nobody gets a zero.
    echo "The autograder itself failed. This submission has no score yet. Please tell your instructors."
fi
exit "$code"
