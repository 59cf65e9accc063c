"""Several takes together: accuracy over all of them, takes added, search by example, and growth."""
