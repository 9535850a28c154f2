#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Loads the modules that modules.json of a folder names in Chromium, and compares: modules.py FOLDER"""

import json
import pathlib
import sys

from webdriver import Browser

FAULTS = (pathlib.Path(__file__).parent / "modules.js").read_text(encoding="utf-8")
LOADED = """const [text, calls, tell] = arguments;
    import(URL.createObjectURL(new Blob([text], { type: "text/javascript" })))
        .then((scene) => tell(faults(scene, calls)), (error) => tell([String(error)]));"""


def main(folder):
    failed = 0
    folder = pathlib.Path(folder)
    with Browser() as browser:
        for one in json.loads((folder / "modules.json").read_text(encoding="utf-8")):
            text = (folder / one["module"]).read_text(encoding="utf-8")
            found = browser.run_until_told(FAULTS + LOADED, text, one["calls"])
            found += browser.dialogs
            if found:
                print("FAILED", one["module"], "in Chromium:", *("\n    " + fault for fault in found[:5]))
            failed += len(found)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
