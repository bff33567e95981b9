"""Measuring ourselves against peers and limits: pairs, networks for peers, processes, and what comes out."""
