"""What is measured, scored, set in tables, drawn, and written into the docs."""
