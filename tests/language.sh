#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every message of the sources has a translation; what people read is Chinese where that is asked for, and what programs
# read (JSON, CSV, emitted code) is the same in every language.
#   language.sh PROGRAM
set -u
program=$(realpath "$1")
root=$(cd "$(dirname "$0")/.." && pwd)
command -v xgettext >/dev/null && command -v msgcmp >/dev/null || { echo 'gettext is not installed'; exit "${ALEMBERT_NO_SKIP:-77}"; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_CACHE_HOME=$work/cache LC_ALL=C.UTF-8
unset LANGUAGE LC_MESSAGES LANG
cd "$root" || exit 5
failed=0
fail() { printf '%s\n' "$@"; failed=1; }

po/update.sh "$work/all.pot" || exit 5
msgcmp po/zh.po "$work/all.pot" >"$work/missing" 2>&1 ||
    fail 'messages without a translation, or whose English text has changed; run po/update.sh and translate in po/zh.po:' \
        "$(grep -v 'header field' "$work/missing")"

# {fmt} takes values that are all numbered or all not; for other translations the English text would be shown.
mixed=$(awk 'BEGIN { RS = "" } { sub(/.*\nmsgstr/, ""); gsub(/[{][{]|[}][}]/, "") } /[{][}:]/ && /[{][0-9]/' po/zh.po)
[ -z "$mixed" ] || fail 'translations in which some values are numbered and some are not:' "$mixed"

# The runtime's messages are translated by their English text: each fixed part of a pattern stands in the runtime.
texts() { # FILE...: the strings of C++ files, one a line
    xgettext --language=C++ --from-code=UTF-8 --no-wrap --output=- "$@" 2>/dev/null | sed -n 's/^\(msgid \)\?"\(.*\)"$/\2/p'
}
sed '/toml++, and/,$d' generator/base/language/libraries.cpp >"$work/patterns.cpp"
texts -a lib/alembert/*/*.?pp >"$work/runtime"
texts --keyword --keyword=to_say:1 "$work/patterns.cpp" | sed 's/\\n/\n/g; s/{[^}]*}/\n/g' >"$work/parts"
[ "$(wc -l <"$work/parts")" -ge 60 ] || fail 'the patterns of the runtime are not found'
while IFS= read -r part; do
    [ "${#part}" -lt 12 ] || grep -qF -- "$part" "$work/runtime" ||
        fail "generator/base/language/libraries.cpp waits for a message with '$part', which lib/ does not say"
done <"$work/parts"

# What is run, and what must be Chinese in its output.
textbook=scenes/textbook
has() { # WORDS COMMAND...: the Chinese output has the words
    local words=$1
    shift
    "$program" "$@" --language zh >"$work/out" 2>&1 </dev/null
    grep -qF "$words" "$work/out" || fail "alembert $* --language zh does not say '$words':" "$(head -n 5 "$work/out")"
}
has '运动方程（第二类拉格朗日方程；坐标独立）' derive $textbook/double_pendulum.toml
has '广义主动力' derive $textbook/heavy_top.toml --by kane --steps
has '已证明' check $textbook/double_pendulum.toml
has '非完整' audit $textbook/sled.toml
has '特征值' linearize $textbook/watt_governor.toml --at alpha=0
has '李雅普诺夫第一近似' stability $textbook/watt_governor.toml --at alpha=0
has '平衡' equilibrium $textbook/watt_governor.toml
has '主转动惯量' inertia $textbook/gyrocompass.toml
has '角速度' kinematics $textbook/heavy_top.toml --steps
has '碰撞方程' impact $textbook/struck_rods.toml
has '估计误差' simulate $textbook/double_pendulum.toml --duration 1
has '退出码' derive --help
has '没有这个文件' derive missing.toml
has '未知命令' deriv
has 'derive 需要 SCENE' derive
has '次右端求值不足' simulate $textbook/double_pendulum.toml --budget 10
"$program" report $textbook/double_pendulum.toml --language zh --no-motion -o "$work/page.html" >/dev/null &&
    grep -q '<html lang="zh-CN">' "$work/page.html" && grep -q '坐标与参数' "$work/page.html" ||
    fail 'the page is not Chinese'

# The same for programs.
same() { # COMMAND...
    "$program" "$@" --json --language en >"$work/en.json" 2>&1
    "$program" "$@" --json --language zh >"$work/zh.json" 2>&1
    cmp -s "$work/en.json" "$work/zh.json" || fail "the JSON of 'alembert $*' changes with the language:" "$(diff "$work/en.json" "$work/zh.json")"
}
same derive $textbook/double_pendulum.toml --steps
same check $textbook/double_pendulum.toml
same audit $textbook/sled.toml
same stability $textbook/watt_governor.toml --at alpha=0
same equilibrium $textbook/watt_governor.toml
same kinematics $textbook/heavy_top.toml
same derive missing.toml
for language in en zh; do
    "$program" emit $textbook/double_pendulum.toml -o "$work/$language" --language $language >/dev/null
    "$program" emit $textbook/double_pendulum.toml -o "$work/$language" --language c --language $language --standalone >/dev/null
    "$program" simulate $textbook/sled.toml --duration 1 -o "$work/$language/motion.csv" --language $language >/dev/null
    "$program" import tests/robots/arm6.urdf -o "$work/$language/arm.toml" --drives --language $language >/dev/null 2>&1
done
diff -r "$work/en" "$work/zh" || fail 'a written file changes with the language'
[ "$(find "$work/zh" -type f | wc -l)" -ge 5 ] || fail 'files are missing'

# Who chooses.
speaks() { # LANGUAGE VARIABLE=VALUE...
    local expected=$1 spoken
    shift
    env -u LC_ALL "$@" "$program" --help >"$work/out"
    spoken=$(grep -q '退出码' "$work/out" && echo zh || echo en)
    [ "$spoken" = "$expected" ] || fail "with $* the language is $spoken"
}
speaks en
speaks zh LANG=zh_CN.UTF-8
speaks zh LC_MESSAGES=zh_CN.UTF-8 LANG=en_US.UTF-8
speaks en LC_ALL=C LANG=zh_CN.UTF-8 LANGUAGE=zh
speaks zh LANGUAGE=de:zh_CN:en LANG=C.UTF-8
speaks en LANGUAGE=en:zh LANG=zh_CN.UTF-8
LANG=zh_CN.UTF-8 "$program" --help --language en | grep -q 'Exit codes' || fail '--language en does not win over LANG'
"$program" derive $textbook/double_pendulum.toml --language de >"$work/out" 2>&1
[ $? = 3 ] || fail '--language de is taken'
exit $failed
