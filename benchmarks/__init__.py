"""Measurements: each module prints one table. They read data a person points them to, and are no part of the package.

takes    what is measured: recorded, joined, or made up by a seed
reports  scores, tables, drawings, and the sections of the docs that they go into
timing   how long something takes, and plain twins
formats  files of every kind: the same cuts, how fast, how large
peers    methods of others, in an environment of their own
chaos, attack, load  what a running service withstands, each a command
"""
