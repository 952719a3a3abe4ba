#!/bin/sh
# Prepares the kit beside this script, once and with a network: packages, and all programs that no submission changes.
# RAYSTEPS_KIT names another place of the kit.
# Afterwards grading needs no network. Written by `raysteps export`.
set -eu

kit=${RAYSTEPS_KIT:-$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)/kit}
@KIT@
# One compiler at a time: a container's memory is small, and it sees all processors of its machine.
export CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-1}"

if [ -z "${RAYSTEPS_VENV:-}" ] && [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null 2>&1; then
    apt-get update
    # The sandbox; where it cannot be had, the kit uses what else there is.
    DEBIAN_FRONTEND=noninteractive apt-get install -y bubblewrap || true
fi

chmod 755 "$kit/raysteps"
cd "$kit"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
# This builds all that grading needs, and shows that this machine grades as it should: the sample is worth all points.
raysteps grade grader/samples/complete --out "$out" --jobs 1
# What the known mistakes answer and draw: a submission's container is thrown away, and would learn it again each time.
raysteps learn
chmod 700 "$kit"
