"""What is kept too long, and how it goes.

retention       the sweep: uploads and analyses since their last use, results since they were made
deletion        blobs first, then the record that points to them
orphaned_blobs  blobs that no record points to
"""
