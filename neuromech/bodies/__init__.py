"""Bodies: one interface, several engines."""
