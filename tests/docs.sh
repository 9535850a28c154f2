#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The documentation says what the program does: the commands in README.md and docs/ are run and their output is
# compared, and docs/commands.md has every verb, option, method, formalism and field of JSON that the program has, and
# no other verb or option.
#   docs.sh PROGRAM
#
# A block ```console holds commands after "$ " and what they print. "…" stands for any lines, or any text in a line.
# Numbers are compared to five digits, those below 1e-7 in size only as small, counts of steps and times not at all. A
# block "```toml NAME" or "```text NAME" is a file of that name, which the commands after it may read; scenes/ and tests/
# are those of the repository.
set -u
program=$(realpath "$1")
root=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/here"
ln -s "$program" "$work/bin/alembert"
ln -s "$root/scenes" "$root/tests" "$work/here"
export PATH=$work/bin:$PATH XDG_CACHE_HOME=$work/cache LC_ALL=C.UTF-8
cd "$work/here" || exit 5
failed=0
commands=0

# What differs from machine to machine or from run to run becomes the same.
normal() {
    awk '{
        if ($0 ~ /^seconds: / || $0 ~ /processor time/) { print "seconds"; next }
        gsub(/[0-9]+ (steps|rejected|evaluations|additions|operations)/, "# count")
        sub(/^[0-9.]+ s$/, "# s")
        rest = $0; line = ""
        while (match(rest, /-?[0-9]+\.[0-9]+(e[-+]?[0-9]+)?|-?[0-9]+e-[0-9]+/)) {
            x = substr(rest, RSTART, RLENGTH) + 0
            shown = x < 1e-7 && x > -1e-7 ? "~0" : sprintf("%.5g", x)
            line = line substr(rest, 1, RSTART - 1) shown
            rest = substr(rest, RSTART + RLENGTH)
        }
        line = line rest
        gsub(/[ \t]+/, " ", line); sub(/ $/, "", line)
        print line
    }'
}

# same EXPECTED PRINTED: line by line; a line "…" in the first stands for any lines, "…" in a line for any text.
same() {
    LC_ALL=C awk 'function alike(w, g, k, end) {
            k = index(w, "…")
            if (k == 0) return w == g
            end = substr(w, k + length("…"))
            if (length(g) < k - 1 + length(end) || substr(g, 1, k - 1) != substr(w, 1, k - 1)) return 0
            return substr(g, length(g) - length(end) + 1) == end
        }
        NR == FNR { want[++n] = $0; next } { got[++m] = $0 }
        END {
            j = 1
            for (i = 1; i <= n; ++i) {
                if (want[i] != "…") { if (j > m || !alike(want[i], got[j++])) exit 1; continue }
                if (i == n) exit 0
                while (j <= m && !alike(want[i + 1], got[j])) ++j
            }
            exit j <= m
        }' "$1" "$2"
}

# run_one FILE LINE COMMAND, the expected output in $work/want; keeps the exit code for "echo $?".
code=0
run_one() {
    if [ "$3" = 'echo $?' ]; then
        echo "$code" >"$work/printed"
    else
        bash -c "$3" >"$work/printed" 2>&1 </dev/null
        code=$?
    fi
    commands=$((commands + 1))
    normal <"$work/want" >"$work/want.normal"
    normal <"$work/printed" >"$work/printed.normal"
    same "$work/want.normal" "$work/printed.normal" && return
    printf '%s:%s: $ %s\nprints something else than the documentation says:\n' "$1" "$2" "$3"
    diff "$work/want.normal" "$work/printed.normal"
    failed=1
}

for path in "$root"/README.md "$root"/README.zh.md "$root"/docs/*.md; do
    [[ $path != */docs/*.zh.md ]] || continue # its blocks are those of the English page, see below
    file=${path#"$root"/}
    inside='' command='' at=0 number=0
    while IFS= read -r line || [ -n "$line" ]; do
        number=$((number + 1))
        case $inside,$line in
            ,'```console') inside=console ;;
            ,'```toml '* | ,'```text '*) inside=${line#'```'*' '} && : >"$inside" ;;
            console,'```' | console,'$ '*)
                [ -z "$command" ] || run_one "$file" "$at" "$command"
                command=''
                : >"$work/want"
                if [ "$line" = '```' ]; then inside=''; else command=${line#'$ '} at=$number; fi
                ;;
            console,*) printf '%s\n' "$line" >>"$work/want" ;;
            ,*) ;;
            *,'```') inside='' ;;
            *) printf '%s\n' "$line" >>"$inside" ;;
        esac
    done <"$path"
done

# The blocks of a translated page (README.zh.md speaks Chinese and is run), apart from comments after "# ", are those of the English page in the same order.
blocks() { awk '/^```/ { inside = !inside; print; next } inside { sub(/[ \t]*(^|[ \t])# .*/, ""); print }' "$1"; }
for page in docs/guide docs/derivations docs/commands docs/scene-language; do
    diff <(blocks "$root/$page.md") <(blocks "$root/$page.zh.md") >"$work/blocks" && continue
    printf '%s.zh.md has other commands, scenes or outputs (>) than %s.md (<):\n' "$page" "$page"
    cat "$work/blocks"
    failed=1
done

# A number in the prose of an English page stands in its translation too.
numbers() {
    sed -E -e '/^```/,/^```/d' -e 's/`[^`]*`//g' -e 's/\]\([^)]*\)//g' -e 's/([0-9]),([0-9]{3})/\1\2/g' "$1" |
        grep -oE '[0-9][0-9.]*[0-9](e-?[0-9]+)?' | sort
}
for page in README docs/guide docs/derivations docs/commands docs/scene-language; do
    stale=$(comm -23 <(numbers "$root/$page.md") <(numbers "$root/$page.zh.md") | tr '\n' ' ')
    [ -z "$stale" ] || { echo "$page.zh.md lacks numbers of $page.md: $stale"; failed=1; }
done

# The sections of docs/commands.md: "## `verb`" with "### `verb --mode`" in it, which has options of its own, and what all
# verbs share under "## Options of all verbs".
section() {
    awk -v title="$1" '
        /^##+ / { depth = length($1); heading = substr($0, depth + 2) }
        /^##+ / && heading == title { on = depth; next }
        /^##+ / && (depth <= on || heading ~ /^`[a-z]+ --/) { on = 0 }
        on' "$root/docs/${2-commands.md}"
}
agree() { # WHAT DOCUMENTED ACTUAL
    [ "$2" = "$3" ] && return
    printf '%s (<) than there are (>):\n' "$1"
    diff <(echo "$2") <(echo "$3")
    failed=1
}
# shellcheck disable=SC2016 # backticks of Markdown
options_in() { grep -oE '^\| `(-[a-z]`, `)?--[a-z-]+' | grep -oE -e '--[a-z-]+' | sort -u; }
verbs=$(alembert --help | awk '/^  [a-z]/ { print $1 }')
modes() { alembert "$1" --help | tr '\n' ' ' | grep -oE 'More options go with [^:]*' | grep -oE -e '--[a-z]+' | sed "s/^/$1 /"; }
questions=$(for verb in $verbs; do echo "$verb" && modes "$verb"; done)
# shellcheck disable=SC2016
documented=$(grep -oE '^(## `[a-z]+|### `[a-z]+ --[a-z]+)`' "$root/docs/commands.md" | tr -d '#`' | sed 's/^ //')
agree 'docs/commands.md has other verbs' "$(sort <<<"$documented")" "$(sort <<<"$questions")"
while IFS= read -r verb; do
    # shellcheck disable=SC2086 # a verb, or a verb and its mode
    help=$(alembert $verb --help)
    has=$(grep -oE '^  (-[a-z], )?--[a-z-]+' <<<"$help" | grep -oE -e '--[a-z-]+' | sort -u)
    says=$( (section 'Options of all verbs'; section "\`$verb\`") | options_in)
    [[ $verb == *' '* ]] || says=$(sort -u <<<"$says"$'\n'"$(modes "$verb" | grep -oE -e '--[a-z]+')" | grep .)
    case $verb in
        *--watch) says=$(grep -vx -e --json -e --strict <<<"$says") ;;
        new) says=$(grep -vx -e --strict <<<"$says") ;;
    esac
    agree "docs/commands.md has other options of $verb" "$says" "$has"
done <<<"$questions"

# watched COMMAND: it makes a page and goes on until it is ended. A program without a server says so; that is enough where
# not all packages are installed.
watched() {
    bash -c "exec $1" >"$work/printed" 2>&1 </dev/null &
    local watching=$! code=0
    until grep -q 'made in' "$work/printed" || ! kill -0 "$watching" 2>/dev/null; do sleep 0.1; done
    kill "$watching" 2>/dev/null
    wait "$watching" || code=$?
    [ "$code" -eq 143 ] || { [ -z "${ALEMBERT_NO_SKIP-}" ] && grep -q 'without cpp-httplib' "$work/printed"; } || return 5
}

# The packages in the table of README.md are those that run.sh and test.sh install, apart from what builds anything.
named=$(sed -n '/^## Packages/,/^## /s/^| \([^|]*\) |.*/\1/p' "$root/README.md" | tail -n +3 | tr -d ' ' | tr ',;' '\n' | sort)
installed=$(. "$root/.ci/setup.sh" && eval "$(sed -n '/^wanted=/,/"$/p' "$root/test.sh")" && xargs -n 1 <<<"$needed $wanted" |
    grep -vxE 'g[+][+]|cmake|ninja-build|pkg-config' | sort)
agree 'README.md names other packages' "$named" "$installed"

# The help of each verb begins with an example, which works; it fits a screen.
while IFS= read -r verb; do
    # shellcheck disable=SC2086 # no verb is no word
    alembert $verb --help >"$work/help"
    example=$(sed -n '1s/^Example: //p' "$work/help")
    lines=$(wc -l <"$work/help")
    wide=$(wc -L <"$work/help")
    case $verb in # those with the most options need more
        emit) most_lines=30 ;;
        simulate) most_lines=34 ;;
        sweep) most_lines=35 ;;
        report) most_lines=26 ;;
        '') most_lines=24 ;;
        *) most_lines=25 ;;
    esac
    if [ "$lines" -gt "$most_lines" ] || [ "$wide" -gt 80 ]; then
        echo "alembert $verb --help has $lines lines of up to $wide columns; expected $most_lines of 80"
        failed=1
    fi
    if [ "$verb" = 'report --watch' ]; then
        watched "$example"
    else
        bash -c "$example" >"$work/printed" 2>&1 </dev/null
    fi
    code=$?
    [ "$code" -le 1 ] || { # 1 is an answer too: unstable, refuted.
        printf 'the example of alembert %s --help fails:\n$ %s\n' "$verb" "$example"
        tail -n 5 "$work/printed"
        failed=1
    }
done <<<$'\n'"$questions"

# Messages name only tables of the scene language.
tables=$(grep -oE '^### `\[+[a-z]+' "$root/docs/scene-language.md" | grep -oE '[a-z]+')
for name in $(grep -oE '\[\[[a-z]+\]\]' "$root/po/zh.po" | tr -d '[]' | sort -u); do
    grep -qx "$name" <<<"$tables" || { echo "a message names [[$name]], which is no table of the scene language"; failed=1; }
done

rooms=$(sed -e '/^#/d' -e '/^$/d' -e '/ = /d' -e 's/ .*//' "$root/generator/rooms.txt")
# shellcheck disable=SC2016
shown=$(section 'The rooms of the generator' design.md | grep -oE '^\| `[a-z/]+`' | tr -d '|` ')
agree 'docs/design.md has other rooms' "$shown" "$rooms"

# need SECTION WORD: it stands there in backticks.
need() {
    section "$1" | grep -qF "\`$2\`" && return
    echo "docs/commands.md does not have $2 in its section $1"
    failed=1
}

# named SECTION: the names that the manual lists under this title are in the section.
named() {
    for name in $(alembert --man simulate | sed -n "/^\.SH ${1^^}/{n;p}" | tr -d '\\,' | tr -d .); do need "$1" "$name"; done
}
named Formalisms
named Methods

# fields VERB ARGUMENTS...: the fields that it prints now are in the section of the verb, but `warnings`, which all have.
fields() {
    # shellcheck disable=SC2086 # a verb, or a verb and its mode
    for field in $(alembert $1 "${@:2}" --json 2>"$work/log" | grep -oE '^  "[a-z_0-9]+"' | tr -d ' "' | grep -vx warnings); do
        need "\`$1\`" "$field"
    done
}
fields derive scenes/textbook/slack_pendulum.toml --reactions
fields 'emit --fmu' cart_pole.fmu scenes/textbook/cart_pole.toml
fields derive scenes/textbook/double_pendulum_joints.toml --reactions
fields derive scenes/textbook/chaplygin_sleigh_in_speeds.toml
fields 'check --formalisms' scenes/textbook/sled.toml
fields audit scenes/textbook/sled.toml
fields check scenes/textbook/double_pendulum.toml
fields check scenes/textbook/central_force.toml tests/derivations/central_force_slip.tex
fields eval scenes/gallery/four_bar_joints.toml --reactions
fields 'eval --kinematics' scenes/gallery/four_bar_joints.toml --steps --jacobian
fields equilibrium scenes/textbook/rotating_hoop.toml
fields equilibrium scenes/textbook/rotating_hoop.toml --vary Omega=0:10
fields 'stability --matrices' scenes/textbook/double_pendulum_joints.toml --at q1=0 --at q2=0
fields stability scenes/textbook/double_pendulum_joints.toml --at q1=0 --at q2=0
fields stability scenes/textbook/rotating_hoop.toml --at theta=0 --lyapunov "theta'^2 + theta^2"
fields stability scenes/stability/mathieu.toml
fields stability scenes/stability/ziegler.toml --vary c=0.1:1:5 --vary P=0:3:5
fields stability scenes/stability/ziegler.toml --vary P=0:3:9
fields stability scenes/stability/ziegler.toml --exponents all --duration 10
fields 'eval --identify' scenes/textbook/double_pendulum_joints.toml
fields 'eval --inverse' scenes/textbook/sled.toml
fields 'eval --impact' scenes/textbook/struck_rods.toml
fields emit scenes/textbook/sled.toml -o solver --jacobian
fields import tests/robots/torso.urdf -o torso.toml
fields simulate scenes/gallery/clock.toml --duration 3
fields simulate scenes/textbook/bouncing_ball.toml --method radau
fields simulate scenes/gallery/four_bar_joints.toml --duration 0.5
fields sweep scenes/textbook/double_pendulum.toml --vary theta1=0:1:2 --duration 0.1
fields sweep scenes/textbook/double_pendulum.toml --vary theta1=0:1:2 --duration 0.1 -o sweep.csv
fields bench scenes/textbook/bouncing_ball.toml --method dop853

[ "$failed" = 0 ] && echo "$commands commands print what the documentation says; verbs, options and fields are all there"
exit "$failed"
