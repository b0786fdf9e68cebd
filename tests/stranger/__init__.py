"""What somebody else's package would hold: a kind of part and a kind of mate, known to no file of the product."""
