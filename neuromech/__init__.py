"""Neuromechanical experiments as documents."""
