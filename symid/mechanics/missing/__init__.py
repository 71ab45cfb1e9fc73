"""Laws that a model may have left out, and all places where they could act."""
