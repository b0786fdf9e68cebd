"""Cams: follower motions, exact profiles, undercut, and the synthesis of their sizes."""
