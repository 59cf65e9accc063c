"""The commands of `caesura`, one file each. What computes is imported when it runs: `--help` answers at once."""
