"""Load capacity of involute gears: the stresses of roots and flanks, and what materials bear."""
