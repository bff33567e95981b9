"""Sweeps: points of a design, runs at them, what was measured as one dataset."""
