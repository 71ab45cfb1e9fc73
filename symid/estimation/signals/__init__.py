"""What is compared: segments of a recording, their windows and pieces, and how fast they move."""
