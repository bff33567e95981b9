"""Recordings turned into numbers, and numbers into verdicts on claims."""
