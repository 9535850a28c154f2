#!/usr/bin/env bash
# What the program writes of every textbook scene is what is committed, to the byte: its C++ from `emit` and its derivation from
# `derive --steps`. tests/golden/hashes.txt has the SHA-256 of all of them; those of fifteen scenes, one for each feature of the
# emitter, are committed as they are too (generated/NAME.cpp, tests/golden/NAME.txt). Each third scene is written by two processes
# (before there was an order, 200 wrote 185 different texts, so one differs soon).
#   reproducible.sh PROGRAM [--update]      --update rewrites what is committed
set -eu
PROGRAM=$(realpath "$1")
update=${2:-}
root=$(cd "$(dirname "$0")/.." && pwd)
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
export PROGRAM WORK
cd "$root"

# written FOLDER SCENE...: FOLDER/NAME.cpp and FOLDER/NAME.txt
written() {
    export FOLDER=$WORK/$1
    mkdir "$FOLDER"
    shift
    # shellcheck disable=SC2016
    printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" bash -c 'set -eu
        "$PROGRAM" emit "$1" -o "$FOLDER" >"$FOLDER/$(basename "$1" .toml).log"
        "$PROGRAM" derive "$1" --steps --full >"$FOLDER/$(basename "$1" .toml).txt"' one
}
hashes() { (cd "$WORK/$1" && sha256sum -- *.cpp *.txt); }

scenes=(scenes/textbook/*.toml)
written first "${scenes[@]}"
hashes first >"$WORK/hashes.txt"
committed=(generated/*.cpp)
if [ "$update" = --update ]; then
    cp "$WORK/hashes.txt" tests/golden/hashes.txt
    for file in "${committed[@]}"; do
        name=$(basename "$file" .cpp)
        cp "$WORK/first/$name.cpp" generated
        cp "$WORK/first/$name.txt" tests/golden
    done
    exit
fi
failed=0
if ! diff tests/golden/hashes.txt "$WORK/hashes.txt" >"$WORK/differences"; then
    echo 'written otherwise than what is committed (<; an older program shows what it was, --update commits the new):'
    cat "$WORK/differences"
    failed=1
fi
for file in "${committed[@]}"; do
    name=$(basename "$file" .cpp)
    for pair in "generated/$name.cpp $name.cpp" "tests/golden/$name.txt $name.txt"; do
        read -r old new <<<"$pair"
        cmp -s "$old" "$WORK/first/$new" && continue
        echo "$old is not what the program writes:"
        diff "$old" "$WORK/first/$new" | head -n 20 || true
        failed=1
    done
done
[ "${#committed[@]}" -eq 15 ] || { echo "${#committed[@]} files in generated/; expected fifteen"; failed=1; }
again=()
for ((k = 2; k < ${#scenes[@]}; k += 3)); do again+=("${scenes[k]}"); done
written second "${again[@]}"
hashes second >"$WORK/again.txt"
if grep -vxFf "$WORK/hashes.txt" "$WORK/again.txt" >"$WORK/differences"; then
    echo 'a second process wrote something else:'
    cat "$WORK/differences"
    failed=1
fi
[ "$failed" = 0 ] && echo "${#scenes[@]} scenes, each third in two processes: the same bytes"
exit "$failed"
