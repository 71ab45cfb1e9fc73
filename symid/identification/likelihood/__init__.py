"""The maximum of the likelihood where noises are estimated: weights by their sizes, process noise beside them."""
