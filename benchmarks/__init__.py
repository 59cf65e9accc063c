"""Measurements: each prints one table. They read data a person points them to, and are no part of the package."""
