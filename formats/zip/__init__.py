"""Zip archives: checked before a member is opened, and written as streams."""
