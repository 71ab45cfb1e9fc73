"""Models with something added: suspects, refits, flexible laws."""
