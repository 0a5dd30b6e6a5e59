# SPDX-License-Identifier: LGPL-2.1-or-later
"""``python -m volfrep``: the same as the ``volfrep`` command."""

from .cli.command import main

if __name__ == "__main__":
    main()
