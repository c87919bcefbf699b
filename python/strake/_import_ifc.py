# SPDX-License-Identifier: Apache-2.0
"""The programs `strake-import-ifc` and `strake-import-many-ifc`: what they do before anything is loaded, and when all is done."""

from __future__ import annotations

import gc
import os
import sys
from typing import NoReturn

# Of what is loaded nothing is garbage: to look through it takes as long as ten of our modules.
_NEW_OBJECTS = 100_000


def one() -> NoReturn:
    """Imports the file that the arguments name."""
    gc.set_threshold(_NEW_OBJECTS)
    from strake.importers.ifc import main

    _leave(main())


def several() -> NoReturn:
    """Imports the files that the lines of standard input name."""
    gc.set_threshold(_NEW_OBJECTS)
    from strake.importers.ifc import main_of_several

    _leave(main_of_several())


def _leave(status: int) -> NoReturn:
    """Ends the process without taking apart what the libraries hold, which takes a quarter of the time that it took to load them."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)
