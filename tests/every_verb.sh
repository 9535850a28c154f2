#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs every verb, with all its options, on every scene of the repository: none may crash, whatever its answer is.
#   every_verb.sh --sanitize [SCENE...]    with the address and undefined-behaviour sanitizers, built for it (long)
#   every_verb.sh PROGRAM [SCENE...]       this one (many minutes)
#   every_verb.sh --fast PROGRAM           eval, inverse, impact, inertia and kinematics alone (seconds)
# A command fails here if it ends by a signal or by a sanitizer, or says that it met an internal error. One that
# is still running after $SECONDS_EACH seconds of processor time (120 if not set) is ended and counted: no failure.
set -eu
usage() {
    sed -n '4,6s/^#   //p' "$0" >&2
    exit 3
}
[ $# -ge 1 ] || usage
root=$(cd "$(dirname "$0")/.." && pwd)
export EVERY=all
if [ "$1" = --fast ]; then
    EVERY=fast
    shift
    [ $# -ge 1 ] || usage
fi
if [ "$1" = --sanitize ]; then
    cd "$root"
    cmake --preset sanitize >/dev/null && cmake --build --preset sanitize --target alembert || exit 5
    PROGRAM=$root/build/sanitize/generator/alembert
else
    PROGRAM=$1
fi
export PROGRAM SECONDS_EACH=${SECONDS_EACH:-120}
shift
if [ $# -eq 0 ]; then
    set -- "$root"/scenes/*/*.toml "$root"/tests/odd/*.toml "$root"/tests/whole.toml
    if [ "$EVERY" != fast ]; then
        set -- "$@" "$root"/tests/robots/*.urdf
    elif [ -z "${ALEMBERT_ALL_SCENES-}" ]; then  # every second scene, as long tests do (CONTRIBUTING.md)
        all=("$@")
        set --
        for ((k = 0; k < ${#all[@]}; k += 2)); do set -- "$@" "${all[k]}"; done
    fi
fi
WORK=$(mktemp -d)
export WORK
trap 'rm -rf "$WORK"' EXIT
export XDG_CACHE_HOME=$WORK/cache
formalisms="lagrange lagrange1 routh kane dalembert nielsen schiehlen roberson-wittenburg recursive hamilton"
export formalisms="$formalisms routhian appell maggi"
export accident='internal error|runtime error:|Sanitizer'
# A sanitizer's own exit code is 1, which here means "refuted".
export ASAN_OPTIONS=exitcode=199:detect_leaks=0 UBSAN_OPTIONS=exitcode=199:print_stacktrace=1

run() { # VERB SCENE OPTIONS...
    local code=0 log=$WORK/log.$$
    (ulimit -t "$SECONDS_EACH" && exec "$PROGRAM" "$@") >/dev/null 2>"$log" </dev/null || code=$?
    if [ "$code" -eq 137 ] || [ "$code" -eq 152 ]; then
        echo "too long: alembert $*"
    elif [ "$code" -ge 128 ] || { [ "$code" -ne 0 ] && grep -qE "$accident" "$log"; }; then
        echo "FAILED with $code: alembert $*"
        grep -vE '^ *$' "$log" | head -n 25 | sed 's/^/    /'
    else
        echo ran
    fi
}
without_compiler() { # SCENE
    run eval "$1" --json --reactions
    run inverse "$1" --json
    run impact "$1" --json
    run inertia "$1" --json
    run kinematics "$1" --steps --json
}
every() { # SCENE
    local scene=$1 name folder short
    name=$(basename "$scene" .toml)
    folder=$(mktemp -d "$WORK/$name.XXXXXX")
    short=(--duration 0.02 --budget 20000)
    without_compiler "$scene"
    run derive "$scene"
    run derive "$scene" --steps --reactions
    for format in latex mathml; do run derive "$scene" --format "$format" --steps --reactions; done
    for format in text latex mathml; do run kinematics "$scene" --format "$format" --steps; done
    run derive "$scene" --json --reactions
    run derive "$scene" --draw "$folder/figure.svg"
    for by in $formalisms; do run derive "$scene" --by "$by" --steps; done
    for verb in agree audit check eval equilibrium linearize stability inertia identify inverse impact; do run "$verb" "$scene"; done
    for verb in agree audit check equilibrium linearize stability; do run "$verb" "$scene" --json; done
    run emit "$scene" -o "$folder"
    run emit "$scene" -o "$folder" --fold --jacobian --batch --json
    run emit "$scene" -o "$folder" --language c --jacobian --standalone
    for version in 2 3; do run fmu "$scene" -o "$folder/unit.fmu" --fmi "$version" --json; done
    run simulate "$scene" "${short[@]}" --json --reactions -o "$folder/motion.csv" --sample 0.01
    for method in rk4 gauss; do run simulate "$scene" "${short[@]}" --method "$method" --step 0.005; done
    for method in radau taylor; do run simulate "$scene" "${short[@]}" --method "$method" --no-estimate; done
    run sweep "$scene" "${short[@]}" --vary t=0:0.1:11 --threads 2
    run sweep "$scene" "${short[@]}" --vary t=0:0.1:2 --json -o "$folder/table.csv"
    run report "$scene" "${short[@]}" -o "$folder/page.html"
    run bench "$scene" "${short[@]}" --reference-seconds 0.1 --csv "$folder/b.csv" --svg "$folder/b.svg"
    rm -rf "$folder"
}
imported() { # ROBOT
    local folder
    folder=$(mktemp -d "$WORK/robot.XXXXXX")
    run import "$1" -o "$folder/floating.toml" --floating --quaternion --json
    run import "$1" -o "$folder/fixed.toml"
    every "$folder/fixed.toml"
    rm -rf "$folder"
}
one() {
    case $1,$EVERY in
        *.urdf,*) imported "$1" ;;
        *,fast) without_compiler "$1" ;;
        *) every "$1" ;;
    esac
}
export -f run without_compiler every imported one

printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" bash -c 'one "$1" >"$(mktemp "$WORK/result.XXXXXX")"' one
cat "$WORK"/result.* >"$WORK/results"
grep -v '^ran$' "$WORK/results" || true
commands=$(grep -cvE '^    ' "$WORK/results")
failed=$(grep -c '^FAILED' "$WORK/results" || true)
long=$(grep -c '^too long' "$WORK/results" || true)
echo "$# scenes, $commands commands, $failed failed, $long ended for their length"
[ "$failed" = 0 ]
