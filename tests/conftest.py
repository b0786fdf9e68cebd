"""Settings of all tests: hypothesis draws the same examples in every run, without a time limit for one of them."""

from hypothesis import settings

settings.register_profile("reproducible", derandomize=True, deadline=None)
settings.load_profile("reproducible")
