"""Attributes compressed as meshoptimizer does."""
