"""Zip archives: judged before anything in them is opened, and written as streams."""
