"""Property tests judge results, never speed: a busy machine is no failure, and the same code has the same examples.

Others are searched for with `pytest --hypothesis-profile search`.
"""

from hypothesis import HealthCheck, settings

settings.register_profile("search", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("steady", settings.get_profile("search"), derandomize=True)
settings.load_profile("steady")
