"""Bodies over plane sections: wheels, plates, holes and their masses."""
