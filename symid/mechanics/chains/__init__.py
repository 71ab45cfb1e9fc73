"""Planar chains of rigid links: a person who stands, a rig on a bench, and what a case says of them."""
