"""One step of a fit: its linear system, the curvature that slopes leave out, and damping within bounds."""
