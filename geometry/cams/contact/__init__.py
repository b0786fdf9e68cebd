"""Where cams and followers touch, and what a follower does that is laid on an outline."""
