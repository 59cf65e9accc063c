"""Switching k-means: a few motions, each a mean of the windowed features, and a price on every change between them.

signal       what is compared: windowed features, each descriptor weighed by what it tells
stretches    the take cut where its features change, before anybody knows which motion is which
settling     the alternation: assign by Viterbi, take means, until nothing changes
separation   whether two motions are two
consensus    how much each descriptor counts
blur         what is too short to be a motion
choice       how many motions there are
certainty    what each cut is worth
"""
