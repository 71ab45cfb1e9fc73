"""The laws that a model may have left out, by what they act on."""
