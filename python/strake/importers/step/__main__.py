# SPDX-License-Identifier: Apache-2.0
"""`python -m strake.importers.step`, called as importers are."""

import sys

from strake.importers.command import run
from strake.importers.step import import_step

if __name__ == "__main__":
    sys.exit(run(import_step))
