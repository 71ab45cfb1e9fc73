"""The parts from which a model is declared: what they are, how they are made, and how they come to a model."""
