"""Labels of a take as people and programs write them; hostile ones are bounded.

read              the labels of a file, whatever its kind, and of two files that are compared
timed_labels      labels of stretches of time, which become one
csv_file          tables
eaf_file          annotations of ELAN
"""
