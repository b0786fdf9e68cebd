"""How a follower moves and how it is guided."""
