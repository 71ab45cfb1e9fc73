"""Many solves: what is asked, where it runs, what is kept, how all of it ended."""
