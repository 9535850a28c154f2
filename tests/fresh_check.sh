#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What README.md names works after ./run.sh, as a user types it: fresh.sh runs this in a fresh machine, with what README.md
# says to export.
set -u
cd "$(dirname "$0")/.." || exit 5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
scene=scenes/textbook/double_pendulum.toml
failed=0
works() { # WHAT COMMAND...
    local what=$1
    shift
    if "$@" >"$work/said" 2>&1 </dev/null; then
        printf 'works: %s\n' "$what"
    else
        printf 'does not work: %s\n' "$what"
        tail -n 10 "$work/said"
        failed=1
    fi
}

watches() { # it says its address, and gives the page there until it is ended
    alembert report $scene --watch --no-motion >"$work/address" 2>&1 &
    local watching=$! code=0
    until grep -q 'made in' "$work/address" || ! kill -0 $watching 2>/dev/null; do sleep 0.1; done
    cat "$work/address"
    python3 -c 'import sys, urllib.request
with urllib.request.urlopen(sys.argv[1] + "page") as page: assert b"<math" in page.read()' \
        "$(grep -oE 'http://[^ ]*/' "$work/address")" || code=$?
    kill $watching
    wait $watching
    return $code
}
is_hdf5() {
    alembert simulate $scene --duration 1 -o "$work/run.h5" && head -c 8 "$work/run.h5" | grep -qaF HDF
}
of_ranks() {
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    mpirun -n 2 --oversubscribe alembert sweep $scene --vary theta1=0:1:20 --duration 0.1 --json >"$work/sweep.json" &&
        grep -q '"ranks": 2' "$work/sweep.json"
}
by_method() {
    alembert simulate $scene --duration 1 --method "$1" --json | grep -q "\"method\": \"$1\""
}
rivals() {
    cmake --build build/release --target alembert-peers >/dev/null &&
        alembert bench $scene --peers --method dop853 --duration 0.1 >"$work/rivals" &&
        for rival in cvode arkode ida gsl odeint; do grep -q "^$rival " "$work/rivals" || return; done
}
in_chinese() {
    alembert check $scene --language zh | grep -q '已证明'
}

works 'alembert report --watch' watches
works 'import alembert in Python' python3 -c 'import alembert, sys
scene = alembert.Scene(sys.argv[1]); assert scene.check() and scene.simulate(duration=1)["theta1"].shape' $scene
works 'tables .h5' is_hdf5
works 'a sweep by two processes (MPI)' of_ranks
works '--method cvode (SUNDIALS)' by_method cvode
works '--method ida (SUNDIALS)' by_method ida
works 'bench --peers' rivals
works 'robots from URDF' alembert import tests/robots/arm6.urdf -o "$work/arm.toml"
printf '<mujoco><worldbody><body name="link"><joint type="hinge" axis="0 1 0"/>%s</body></worldbody></mujoco>' \
    '<inertial pos="0 0 -1" mass="1" diaginertia="1 1 1"/>' >"$work/link.xml"
works 'robots from MJCF' alembert import "$work/link.xml" -o "$work/link.toml"
works '--language zh' in_chinese
exit $failed
