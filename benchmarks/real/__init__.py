"""Takes that nobody made for this: how right the methods are on them, and on parts of them."""
