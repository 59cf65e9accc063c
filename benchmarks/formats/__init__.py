"""Files of every kind: whether they give the same cuts, how fast they are read, how large their clips are."""
