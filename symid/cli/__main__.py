"""`python -m symid.cli` is `symid`."""

import sys

from symid.cli.main import main

sys.exit(main())
