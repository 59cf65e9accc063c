"""`caesura compare`: the methods side by side on takes that somebody has labelled.

labelled_takes  the takes of folders and files, with the labels beside them
measurement     what every method finds in a take, in what time and memory
table           the figures as a table
"""
