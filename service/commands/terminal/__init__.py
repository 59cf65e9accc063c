"""What a terminal shows.

progress_bar   how far the work is
segment_table  the segments in lines
"""
