"""symid: identify mechanical systems and their feedback controllers from recordings."""
