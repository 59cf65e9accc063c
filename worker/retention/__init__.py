"""Deletion of what is too old.

sweep           the hourly sweep: uploads and analyses by their last use, results by their age
deletion        deletion of blobs first, then of the record that points to them
orphaned_blobs  blobs that no record points to
"""
