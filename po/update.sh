#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Brings po/zh.po up to date: collects the messages of the sources, keeps the translations that there are, and says what
# is left to translate. Needs gettext.
#   po/update.sh             merges into po/zh.po
#   po/update.sh FILE.pot    only collects the messages into FILE.pot
set -eu
cd "$(dirname "$0")/.."
template=${1-}
[ -n "$template" ] || { template=$(mktemp) && trap 'rm -f "$template"' EXIT; }

find generator -name '*.?pp' ! -path 'generator/plugins/*' ! -path 'generator/base/language/say.hpp' | LC_ALL=C sort |
    xgettext --files-from=- --language=C++ --from-code=UTF-8 --output="$template" --add-location=file --no-wrap \
        --package-name=alembert --keyword --keyword=say:1 --keyword=say_on:2 --keyword=to_say:1 \
        --flag=say:1:no-c-format --flag=say_on:2:no-c-format --flag=to_say:1:no-c-format
sed -i -e 's/charset=CHARSET/charset=UTF-8/' -e '/^"POT-Creation-Date:/d' -e '/^#, no-c-format$/d' \
    -e '/^#, c-format$/d' "$template"
[ $# -eq 0 ] || exit 0

msgmerge --quiet --update --backup=none --no-wrap --add-location=file --previous po/zh.po "$template"
msgattrib --no-obsolete --no-wrap --output-file=po/zh.po po/zh.po
sed -i -e '/^"PO-Revision-Date:/d' -e '/^"POT-Creation-Date:/d' po/zh.po
LC_ALL=C msgfmt --statistics --output-file=/dev/null po/zh.po
