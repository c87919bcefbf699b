# SPDX-License-Identifier: Apache-2.0
"""`python -m strake.importers.ifc`, which is `strake-import-ifc`."""

import sys

from strake.importers.ifc import main

sys.exit(main())
