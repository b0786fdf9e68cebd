"""Tests of ``geometry/gears/ratchets``."""
