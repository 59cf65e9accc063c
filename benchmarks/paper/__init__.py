"""The paper's table and figures, redone on what can be had: `python -m benchmarks.paper --cmu CMU`.

stand_ins   takes of our own making in place of the unpublished face, exercise and squirrel
table1      Table 1: the takes, their settings, and what they take
figure7     figures 6 and 7: the method beside spectral clustering, ACA and HACA on trials of CMU 86
barbic      precision and recall of Barbič's methods on the same trials
pictures    figures 1, 3, 4, 6 and 8
"""
