"""Tests of ``geometry/kinematics``."""
