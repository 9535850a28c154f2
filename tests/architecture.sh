#!/usr/bin/env bash
# The layers of docs/design.md, held by grep: who may include what; and how long functions and files may be. With --count: how
# many rooms, arrows and floors there are, lines, and functions.
set -u
cd "$(dirname "$0")/.."
failed=0
forbid() { # REASON PATTERN FILES...
    local reason=$1 pattern=$2
    shift 2
    local found
    found=$(grep -nE "$pattern" "$@" 2>/dev/null)
    [ -z "$found" ] && return
    printf '%s:\n%s\n' "$reason" "$found"
    failed=1
}
files() { find "$@" -name '*.?pp' | sort; } # FOLDER... [-maxdepth N]
ginac='#include.*(ginac|cln/)'
mapfile -t runtime < <(files lib)
mapfile -t scene < <(files generator/scene)
mapfile -t graph < <(files generator/program generator/codegen | grep -v '^generator/program/lower/')
mapfile -t generator < <(files generator | grep -v -e '^generator/commands' -e '^generator/main.cpp')
mapfile -t not_reader < <(files lib generator | grep -v '^generator/scene/')
mapfile -t not_module < <(files lib generator | grep -v '^lib/alembert/native/module.cpp')

# The chambers of generator/rooms.txt: each includes only itself, what stands before it, and the runtime.
plan=$(sed -e '/^#/d' -e '/^$/d' generator/rooms.txt)
mapfile -t chambers < <(sed -e '/ = /d' -e 's/ .*//' <<<"$plan")
mapfile -t rooms < <(printf '%s\n' "${chambers[@]}" | sed 's|/.*||' | awk '!seen[$0]++')
every=$(IFS='|'; echo "${rooms[*]}")
later=$(IFS='|'; echo "${chambers[*]}")
for chamber in "${chambers[@]}"; do
    later=${later#"$chamber"}
    later=${later#|}
    [ -d "generator/$chamber" ] || { echo "generator/rooms.txt names '$chamber', which does not exist"; failed=1; continue; }
    [ -z "$later" ] && continue
    mapfile -t inside < <(files "generator/$chamber" -maxdepth 1)
    forbid "$chamber includes a later chamber" "#include \"($later)/[a-z_0-9]+\.hpp\"" "${inside[@]}"
done
for folder in $(find generator -mindepth 1 -type d ! -path 'generator/plugins*'); do
    [[ " ${chambers[*]} " == *" ${folder#generator/} "* || " ${rooms[*]} " == *" ${folder#generator/} "* ]] ||
        { echo "$folder is not in generator/rooms.txt"; failed=1; }
done

# included ROOM FROM...: the headers of a room that files elsewhere include, and no others stand at its door.
included() {
    local room=$1
    shift
    grep -rhoE "#include \"$room/[a-z_0-9/]+\.hpp" "$@" --include='*.?pp' | sed "s|.*\"$room/||" | sort -u
}
for room in "${rooms[@]}"; do
    mapfile -t others < <(find generator -mindepth 1 -maxdepth 1 ! -name "$room" ! -name rooms.txt)
    door=$(sed -n "s/^$room = //p" <<<"$plan" | tr ' ' '\n' | sort -u)
    used=$(included "$room" "${others[@]}" python)
    [ "$door" = "$used" ] || {
        echo "generator/rooms.txt: the door of $room (<: nobody outside includes it; >: it is included and not listed)"
        diff <(echo "$door") <(echo "$used") | grep '^[<>]'
        failed=1
    }
done

# --count: rooms, arrows between rooms, and floors: a room stands one floor above the highest that it includes.
if [ "${1-}" = --count ]; then
    declare -A floor
    arrows=0 floors=0
    for room in "${rooms[@]}"; do
        floor[$room]=1
        for other in "${rooms[@]}"; do
            [ "$room" != "$other" ] && [ -n "$(included "$other" "generator/$room")" ] || continue
            arrows=$((arrows + 1))
            [ "${floor[$room]}" -gt "${floor[$other]:-0}" ] || floor[$room]=$((${floor[$other]} + 1))
        done
        [ "$floors" -ge "${floor[$room]}" ] || floors=${floor[$room]}
    done
    echo "${#rooms[@]} rooms, $arrows arrows between them, $floors floors"
fi

forbid 'the runtime includes the generator' "#include \"($every)/" "${runtime[@]}"
forbid 'the runtime includes GPL libraries' "$ginac" "${runtime[@]}"
forbid 'GiNaC in the scene layer' "$ginac" "${scene[@]}"
forbid 'GiNaC in straight-line code' '#include.*(ginac|"(algebra|model|program/lower)/)' "${graph[@]}"
forbid 'commands are used below the commands' '#include "commands/' "${generator[@]}"
forbid 'toml++ outside the reader' '#include.*toml\+\+' "${not_reader[@]}"
mapfile -t not_options < <(files lib generator | grep -v -e '^generator/commands/\(verb.cpp\|help\|option_rules.cpp\|command_line.cpp\)')
forbid 'CLI11 outside the files that walk through all verbs' '#include.*CLI' "${not_options[@]}"
mapfile -t not_urdf < <(files lib generator | grep -v '^generator/scene/import/')
forbid 'urdfdom outside its reader' '#include.*(urdf_|tinyxml|console_bridge)' "${not_urdf[@]}"
mapfile -t not_machine < <(files lib generator | grep -v '^generator/codegen/machine/encoder.hpp')
forbid 'xbyak outside the encoder' '#include.*xbyak' "${not_machine[@]}"
mapfile -t not_server < <(files lib generator | grep -v '^generator/commands/page_server.cpp')
forbid 'cpp-httplib outside the server of pages' '#include.*httplib' "${not_server[@]}"
mapfile -t not_executable < <(files lib generator | grep -v '^lib/alembert/native/executable.cpp')
forbid 'dlfcn outside the module' '#include <dlfcn' "${not_module[@]}"
forbid 'memory that can be run outside its one file' 'PROT_EXEC' "${not_executable[@]}"
forbid 'the emitted code includes something' '^ *#include' templates/solver.cpp.mustache generated/*.cpp
forbid 'a shell' '\b(system|popen)\(' "${runtime[@]}" "${generator[@]}"

# Two types of one name in one namespace, each in a header of its own, are undefined behaviour that no compiler sees where no
# file includes both: the program crashes.
types=$(find lib generator -name '*.hpp' -exec sed -nE \
    -e 's/^namespace (alembert::)?([a-z_:]*) \{.*/@\2/p' -e 's/^\}  \/\/ namespace .*/@/p' \
    -e 's/^(struct|class|enum class|enum) ([A-Za-z_0-9]+)( final)?( :[^;]*)? \{.*/\2/p' {} + |
    awk '/^@/ { space = substr($0, 2); next } { print space "::" $0 }' | sort | uniq -d)
[ -z "$types" ] || { printf 'several headers have a type of this name:\n%s\n' "$types"; failed=1; }

# The emitted file's copy of the ABI's structs, word for word.
words() { sed -n "/^struct $1 {/,/^};/p" "$2" | sed 's|///.*||' | tr -s ' \n' ' '; }
for struct in $(sed -n "s/^struct \([a-z_]*\) {/\1/p" lib/alembert/native/abi.hpp); do
    [ "$(words $struct lib/alembert/native/abi.hpp)" = "$(words $struct templates/solver.cpp.mustache)" ] ||
        { echo "templates/solver.cpp.mustache and lib/alembert/native/abi.hpp disagree about $struct"; failed=1; }
done
missing=$(files lib generator tools tests | xargs grep -L 'SPDX-License-Identifier')
[ -z "$missing" ] || { printf 'no licence line in:\n%s\n' "$missing"; failed=1; }

# Functions of at most 80 lines and 6 parameters, files of at most 700 lines.
python3 tests/measures.py "$@" || failed=1
[ "$failed" = 0 ] && echo 'the layers hold'
exit "$failed"
