"""Sheets: a timeline of clips laid end to end, each performed once, as artists and packs of clips keep them.

method           the part of the default method that cuts a sheet
sheet_detection  whether a take is a sheet, and why
clip_division    the best division of a sheet into clips
"""
