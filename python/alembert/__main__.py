# SPDX-License-Identifier: GPL-2.0-or-later
"""The program itself: `python -m alembert simulate pendulum.toml`, and the command `alembert` of the wheel."""

import signal
import sys

from . import _alembert


def main():
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends the program at once, as it does without Python
    sys.exit(_alembert.command_line(sys.argv[1:]))


if __name__ == "__main__":
    main()
