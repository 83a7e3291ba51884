"""`python -m atlas_cueing` is `atlas-cueing`."""

import sys

from .cli import main

sys.exit(main())
