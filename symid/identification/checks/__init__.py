"""What speaks against a solution: asked of others than its solver."""
