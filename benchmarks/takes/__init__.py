"""Takes whose motions are known: recorded, joined, or made up by a seed; and bodies of any size."""
