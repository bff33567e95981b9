"""Figures and tables made from recordings."""
