"""The page's own files.

joined_modules  its modules in two files instead of a hundred
page_files      the files as they are served
"""
