"""Loss of contact: the period map where contact ends at 3 sigma, and its orbits."""
