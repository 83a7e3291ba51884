"""Method `preview`: the whole flight is known, so the whole motion of the platform is planned at once.

For batch runs and recorded logs. It is the ceiling that methods which know only the past can be
measured against: the same cost (`PreviewParameters`), the same limits, all of the future. Only this
    package knows clarabel.
"""

from .motion_plan import preview
from .preview import Preview

__all__ = [
    "Preview",
    "preview",
]
