"""Tests of ``parts/cams/disk_cam``."""
