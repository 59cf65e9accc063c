"""The surface as one connected thing: what measures need that look further than a single triangle."""
