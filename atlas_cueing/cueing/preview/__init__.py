"""Method `preview`: the whole flight is known, so the platform's whole motion is planned at once.

For batch runs and recorded logs. It is the ceiling that causal methods can be measured against:
the same cost (`PreviewParameters`), the same limits, all of the future. Only this package knows
clarabel.
"""

from .preview_parameters import METHOD, PreviewParameters

__all__ = ["METHOD", "PreviewParameters"]
