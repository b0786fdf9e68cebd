"""Cams that hold their follower from both sides: conjugate pairs and yokes."""
