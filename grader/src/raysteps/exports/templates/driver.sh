#!/bin/sh
# Grades one submission on Autolab: driver.sh HANDIN. Written by `raysteps export autolab`.
# What is printed is shown to the student; the last line is what Autolab reads. Where this ends with another code than 0,
# the Makefile prints a last line without scores.
set -u

handin=$(pwd -P)/${1:?the file that was handed in}
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
kit=${RAYSTEPS_KIT:-/opt/raysteps/kit}
[ -d "$kit" ] || kit=$here/kit
@KIT@
export CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-1}"
cd "$kit" || exit 4
raysteps export autolab --run "$handin" @OPTIONS@
