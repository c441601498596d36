"""Histograms, estimates, tails and verdicts."""
